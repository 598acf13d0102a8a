# make demo: build, run the quick-start case, show a picture.    make test: build and run all tests.
BUILD := build
JOBS ?= $(shell nproc)

.PHONY: help build demo test bench format tidy clean packages configure

help:
	@echo "make build    the program, build/spume"
	@echo "make demo     build, run cases/quickstart into demo/, make a picture, say what happened"
	@echo "make test     build and run all tests"
	@echo "make bench    build and run the benchmarks"
	@echo "make format   lay out all sources with clang-format"
	@echo "make tidy     check all sources with clang-tidy"
	@echo "make clean    remove build/ and demo/"

packages:
	@tools/install_packages.sh

configure: packages
	@cmake -S . -B $(BUILD) -G Ninja -DCMAKE_BUILD_TYPE=Release > $(BUILD).log 2>&1 || (cat $(BUILD).log; exit 1)
	@rm -f $(BUILD).log

build: configure
	@cmake --build $(BUILD) --parallel $(JOBS) --target spume

demo: build
	@$(BUILD)/spume run cases/quickstart/case.toml -o demo --force
	@$(BUILD)/spume render demo -o demo/picture.png
	@$(BUILD)/spume info demo
	@echo "The picture is demo/picture.png; demo/films.pvd opens in ParaView."

test: configure
	@cmake --build $(BUILD) --parallel $(JOBS)
	@ctest --test-dir $(BUILD) --output-on-failure --parallel 2

bench: configure
	@cmake --build $(BUILD) --parallel $(JOBS)
	@set -e; for bench in $(BUILD)/bench_*; do echo "$$bench"; $$bench; done

format tidy: configure
	@cmake --build $(BUILD) --target $@

clean:
	rm -rf $(BUILD) demo
