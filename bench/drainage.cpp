// Drainage of the foam of the paper's Fig. 15 to 16.1 s on meshes of different size, graded to the borders:
// wall and processor time, steps, and what each part of the steps takes. The accepted steps of one run are
// repeated part by part for the shares, each from where it started, on the equations of the program. Usage:
// bench_drainage [--triangles 20000 200000]
#include <CLI/CLI.hpp>
#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <utility>
#include <vector>

#include "spume/base/stage_times.hpp"
#include "spume/drainage/drain.hpp"
#include "spume/drainage/step.hpp"
#include "spume/parallel/session.hpp"
#include "spume/verification/drainage_runs.hpp"
#include "spume/verification/film_networks.hpp"
#include "spume/verification/four_bubble_films.hpp"

namespace {

using namespace spume;

constexpr double radius = 1e-3;

double wall() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

/// The exact cluster with about this number of triangles, edges at borders a quarter of those inside films.
state::FilmNetwork cluster(int n_triangles) {
  mesh::FilmMesh films;
  for (double spacing = 0.3e-3; films.n_triangles() < n_triangles; spacing *= 0.96) {
    films = verification::four_bubble_films(radius, spacing);
    if (6 * films.n_triangles() < n_triangles) continue;  // far from enough, refined or not
    for (int level = 0; level < 2; ++level)
      films = verification::refine_around(films, mesh::VertexKind::Border, 4,
                                          verification::four_bubble_middle(radius));
  }
  auto network = verification::uniform_network(std::move(films), 5e-6, 5e-8);
  for (std::size_t d = 0; d < network.curvature_squared.size(); ++d)
    if (network.topology.lamella[network.topology.film_dof[d].lamella].phase_a == 0)
      network.curvature_squared[d] = 2 / (radius * radius);
  return network;
}

struct Step {
  double length;
  std::vector<double> half_thickness, border_area;  ///< where it started
};

struct Run {
  double seconds, processor_seconds;
  std::vector<Step> steps;
  drainage::DrainageOutcome outcome;
};

Run drain(state::FilmNetwork network) {
  Run run{};
  std::vector<double> half_thickness = network.half_thickness, border_area = network.border_area;
  const double start = wall(), processor_start = processor_time();
  run.outcome = drainage::drain(
      network, verification::fig15_materials(), {.max_time = 16.1, .tolerance = 0.02, .max_step = 10}, 0,
      [](const auto&) { return state::ThinPoint{}; },
      [&](const drainage::DrainageProgress& progress, const state::FilmNetwork& now) {
        run.steps.push_back({progress.step, std::move(half_thickness), std::move(border_area)});
        half_thickness = now.half_thickness;
        border_area = now.border_area;
        return true;
      });
  run.seconds = wall() - start;
  run.processor_seconds = processor_time() - processor_start;
  return run;
}

/// The steps once more, part by part.
StageTimes shares(state::FilmNetwork network, const std::vector<Step>& steps) {
  constexpr double gamma = 1 - 1 / std::numbers::sqrt2;
  StageTimes times;
  drainage::DrainageEquations equations(network, verification::fig15_materials());
  times.lap("set-up, orderings");
  drainage::Unknowns y, k1, k2, stage;
  const auto add = [](std::vector<double>& to, double factor, const std::vector<double>& k) {
    for (std::size_t i = 0; i < to.size(); ++i) to[i] += factor * k[i];
  };
  const auto subtract_mass = [&](drainage::Unknowns& right, const drainage::Unknowns& k) {
    for (std::size_t i = 0; i < k.film.size(); ++i) right.film[i] -= 2 * equations.film_area()[i] * k.film[i];
    for (std::size_t i = 0; i < k.border.size(); ++i)
      right.border[i] -= 2 * equations.border_length()[i] * k.border[i];
  };
  for (const auto& [dt, half_thickness, border_area] : steps) {
    network.half_thickness = half_thickness;
    network.border_area = border_area;
    y = equations.read(network);
    times.restart();
    equations.rates(y, k1);
    equations.linearise(y);
    times.lap("assembly");
    equations.factorise(gamma * dt);
    times.lap("factorisation");
    equations.solve(k1);
    times.lap("solves");
    stage = y;
    add(stage.film, dt, k1.film);
    add(stage.border, dt, k1.border);
    equations.rates(stage, k2);
    subtract_mass(k2, k1);
    times.lap("assembly");
    equations.solve(k2);
    times.lap("solves");
  }
  return times;
}

}  // namespace

int main(int argc, char** argv) {
  const parallel::Session session(argc, argv);
  CLI::App program("Drainage of the foam of Fig. 15", "bench_drainage");
  std::vector<int> triangles{20000, 200000};
  program.add_option("--triangles", triangles, "of the meshes, about");
  CLI11_PARSE(program, argc, argv);
  double last_seconds = 0, last_triangles = 0;
  for (const int n : triangles) {
    const auto network = cluster(n);
    const Run run = drain(network);
    const double size = network.mesh.n_triangles();
    std::printf(
        "%d triangles, %zu unknowns of films: %.2f s of wall, %.2f s of processor time, %d steps and %d "
        "rejected, ledger %.1e\n",
        network.mesh.n_triangles(), network.half_thickness.size(), run.seconds, run.processor_seconds,
        run.outcome.n_steps, run.outcome.n_rejected, run.outcome.ledger_error);
    if (last_seconds > 0)
      std::printf("  growth of processor time with triangles: power %.2f\n",
                  std::log(run.processor_seconds / last_seconds) / std::log(size / last_triangles));
    const StageTimes times = shares(network, run.steps);
    double sum = 0;
    for (const auto& [part, seconds] : times.seconds()) sum += seconds;
    for (const auto& [part, seconds] : times.seconds())
      std::printf("  %-20.*s %8.3f s %5.1f %%\n", static_cast<int>(part.size()), part.data(), seconds,
                  100 * seconds / sum);
    std::fflush(stdout);
    last_seconds = run.processor_seconds;
    last_triangles = size;
  }
}
