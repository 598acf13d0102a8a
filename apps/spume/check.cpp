#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <cstdio>
#include <memory>

#include "apps/spume/commands.hpp"
#include "apps/spume/load_case.hpp"
#include "spume/config/assess.hpp"

namespace spume::app {

namespace {

struct Request {
  std::string file;
  std::vector<std::string> options;
};

void check(const parallel::Communicator& communicator, const Request& request) {
  const LoadedCase loaded = load_case(communicator, request.file, request.options);
  communicator.on_root([&] {
    const auto assessment = config::assess(loaded.run_case, loaded.bubbles);
    std::printf("%s is a valid case\n%s", request.file.c_str(),
                config::report(assessment, loaded.run_case).c_str());
  });
}

}  // namespace

void add_check(CLI::App& program, const parallel::Communicator& communicator) {
  const auto request = std::make_shared<Request>();
  CLI::App* command = program.add_subcommand(
      "check", "validate a case; say how large, how fast, how wet it is, and what to beware of");
  command->add_option("CASE.toml", request->file, "the case file")->required();
  command->add_option("--set", request->options, "section.key=value, in place of what the file says")
      ->allow_extra_args(false);
  command->callback([request, communicator] { check(communicator, *request); });
}

}  // namespace spume::app
