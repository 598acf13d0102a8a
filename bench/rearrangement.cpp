// One step of the rearrangement of a cluster of bubbles: the share of each stage, and the ratio to one
// Poisson solve by FFTW of the same grid, timed between the steps of the same run: machines differ and drift,
// ratios less so. The foam starts as overlapping spheres, far from equilibrium, and is reconstructed by the
// rule of the program. Usage: bench_rearrangement [--cells 64 128] [--bubbles 1 4 27 100] [--steps 24]
// [--warm-up 8]
#include <sys/resource.h>

#include <CLI/CLI.hpp>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <list>
#include <optional>
#include <string>
#include <vector>

#include "bench/poisson_reference.hpp"
#include "spume/base/stage_times.hpp"
#include "spume/flow/navier_stokes.hpp"
#include "spume/parallel/session.hpp"
#include "spume/simulation/foam_motion.hpp"
#include "spume/simulation/initial_foam.hpp"

namespace {

using namespace spume;

double wall() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

/// A cluster that fills most of the box whatever the number of bubbles; for 100 bubbles the mean radius is 5
/// cells of 64.
simulation::Case cluster_case(int cells, int bubbles) {
  simulation::Case run_case;
  const double half = 8e-3;
  run_case.box = {{-half, -half, -half}, {half, half, half}, {cells, cells, cells}};
  run_case.materials.gas = {1.2, 1.8e-5};
  run_case.materials.film.surface_tension = 0.03;
  const double diameter = 0.8 * (2 * half) / (std::cbrt(bubbles) + 0.5);
  if (bubbles == 1) {
    const double r = 0.5 * diameter;
    run_case.foam.bubble = {{{0, 0, 0}, {1.2 * r, r, 0.9 * r}}};
  } else {
    run_case.foam.cluster = simulation::ClusterShape{
        .count = bubbles, .mean_diameter = diameter, .spread = 0.15, .seed = 1, .center = {}};
  }
  return run_case;
}

double median(std::vector<double> values) {
  std::nth_element(values.begin(), values.begin() + values.size() / 2, values.end());
  return values[values.size() / 2];
}

/// Seconds of every stage since `before`.
StageTimes since(const StageTimes& before, StageTimes now) {
  for (const auto& [stage, seconds] : before.seconds()) now.add(stage, -seconds);
  return now;
}
double total_of(const StageTimes& times) {
  double sum = 0;
  for (const auto& [stage, seconds] : times.seconds()) sum += seconds;
  return sum;
}

/// A foam that rearranges as the program does it.
class Rearrangement {
 public:
  explicit Rearrangement(const simulation::Case& run_case)
      : case_(run_case), grid_(parallel::Communicator::world(), run_case.box), run_(grid_) {
    std::vector<state::Event> events;
    simulation::make_initial_foam(case_, run_.foam, events);
    motion_.emplace(grid_, case_, run_);
    forget_times();
  }

  void step() {
    last_ = motion_->step();
    n_reconstructions_ += last_.reconstructed;
  }

  void forget_times() {
    steps_before_ = motion_->times();
    gas_before_ = motion_->gas_times();
    reconstructions_before_ = motion_->reconstruction_times();
    n_reconstructions_ = 0;
  }
  /// Stages of all steps since forget_times(), in place of "gas" its own stages.
  StageTimes times() const {
    const StageTimes steps = since(steps_before_, motion_->times()),
                     gas = since(gas_before_, motion_->gas_times()), reconstructions = reconstruction_times();
    StageTimes all;
    for (const auto& [stage, seconds] : steps.seconds())
      if (stage != "gas") all.add(stage, seconds);
    for (const auto& [stage, seconds] : gas.seconds()) all.add(name("gas: ", stage), seconds);
    for (const auto& [stage, seconds] : reconstructions.seconds())
      all.add(name("reconstruction: ", stage), seconds);
    return all;
  }
  int n_reconstructions() const { return n_reconstructions_; }
  double reconstruction_seconds() const { return total_of(reconstruction_times()); }
  int n_triangles() const { return run_.foam.films.n_triangles(); }
  double energy() const {
    return last_.kinetic_energy + 2 * case_.materials.film.surface_tension * last_.film_area;
  }
  double speed() const { return flow::max_speed(run_.foam.gas); }

 private:
  StageTimes reconstruction_times() const {
    return since(reconstructions_before_, motion_->reconstruction_times());
  }
  std::string_view name(const char* group, std::string_view stage) const {
    return names_.emplace_back(group + std::string(stage));
  }

  simulation::Case case_;
  grid::Grid grid_;
  simulation::RunState run_;
  std::optional<simulation::FoamMotion> motion_;
  simulation::MotionStep last_;
  int n_reconstructions_ = 0;
  StageTimes steps_before_, gas_before_, reconstructions_before_;
  mutable std::list<std::string> names_;  // that StageTimes refer to
};

double peak_memory() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return parallel::Communicator::world().sum(1024.0 * static_cast<double>(usage.ru_maxrss));  // [bytes]
}

void run(int cells, int bubbles, int n_warm_up, int n_steps) {
  const double memory_before = peak_memory();
  Rearrangement foam(cluster_case(cells, bubbles));
  for (int n = 0; n < n_warm_up; ++n) foam.step();
  const double memory = peak_memory();
  bench::PoissonReference reference(cells);
  foam.forget_times();
  std::vector<double> poisson;
  double total = 0, wall_time = 0;
  for (int n = 0; n < n_steps; ++n) {
    double start = processor_time();
    reference.solve();
    poisson.push_back(processor_time() - start);
    start = processor_time();
    const double wall_start = wall();
    foam.step();
    total += processor_time() - start;
    wall_time += wall() - wall_start;
  }

  const auto& world = parallel::Communicator::world();
  const double speed = foam.speed();
  if (!world.is_root()) return;
  const double n_cells = std::pow(static_cast<double>(cells), 3), unit = median(poisson);
  const double step = total / n_steps;
  std::printf("\n%d^3 cells, %d bubbles, %d triangles, %d ranks; %d steps, %d reconstructions\n", cells,
              bubbles, foam.n_triangles(), world.size(), n_steps, foam.n_reconstructions());
  std::printf("  one Poisson solve %9.5f s (median; best %.5f)\n", unit,
              *std::min_element(poisson.begin(), poisson.end()));
  std::printf("  a step            %9.5f s = %.1f Poisson solves; %.3g cells*steps/s/core; wall %.5f s\n",
              step, step / unit, n_cells / step / world.size(), wall_time / n_steps);
  const double reconstructing = foam.reconstruction_seconds() / unit;
  std::printf("  without reconstruction %.1f Poisson solves", (total / unit - reconstructing) / n_steps);
  if (foam.n_reconstructions() > 0)
    std::printf("; one reconstruction %.0f, every %.1f steps here", reconstructing / foam.n_reconstructions(),
                static_cast<double>(n_steps) / foam.n_reconstructions());
  std::printf("\n");
  if (memory > memory_before)
    std::printf("  peak memory       %9.0f bytes a cell, the program's own %.0f MB included\n",
                memory / n_cells, memory_before / 1e6);
  std::printf("  energy %.15g J, speed %.15g m/s\n", foam.energy(), speed);
  const StageTimes times = foam.times();
  for (const auto& [part, seconds] : times.seconds())
    std::printf("    %-32.*s %9.5f s %6.2f Poisson %5.1f %%\n", static_cast<int>(part.size()), part.data(),
                seconds / n_steps, seconds / n_steps / unit, 100 * seconds / total);
  std::fflush(stdout);
}

}  // namespace

int main(int argc, char** argv) {
  const parallel::Session session(argc, argv);
  CLI::App program("Cost of one step of the rearrangement", "bench_rearrangement");
  std::vector<int> cells{64, 128}, bubbles{1, 4, 27, 100};
  int n_steps = 24, n_warm_up = 8;
  program.add_option("--cells", cells, "cells along each side");
  program.add_option("--bubbles", bubbles, "bubbles of the cluster");
  program.add_option("--steps", n_steps, "steps that are timed");
  program.add_option("--warm-up", n_warm_up, "steps before those");
  CLI11_PARSE(program, argc, argv);
  for (const int n : cells)
    for (const int b : bubbles) run(n, b, n_warm_up, n_steps);
}
