// Drainage of the foam of the paper's Fig. 15 to 16.1 s on meshes of different size, graded to the borders:
// wall and processor time, steps, and what each part of the steps takes. The accepted steps of one run are
// repeated part by part for the shares, each from where it started, on the equations of the program. On
// several ranks, processor time and shares are those of the first, waiting included. With --lamellae, the
// time of single lamellae by their size, from which lamella_cost() has its power; with --borders, that of
// borders by themselves in steps of either scheme. Usage:
// [mpirun -n 2] bench_drainage [--triangles 20000 200000] [--lamellae] [--borders]
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
#include "spume/verification/four_borders.hpp"
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
  return verification::four_bubble_network(std::move(films), radius);
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

parallel::Communicator world() {
  return parallel::Communicator::world();
}

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
      },
      world());
  run.seconds = wall() - start;
  run.processor_seconds = processor_time() - processor_start;
  return run;
}

/// The steps once more, part by part.
StageTimes shares(state::FilmNetwork network, const std::vector<Step>& steps) {
  constexpr double gamma = 1 - 1 / std::numbers::sqrt2;
  StageTimes times;
  drainage::DrainageEquations equations(network, verification::fig15_materials(), world());
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
    equations.linearise(y, k1);
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

/// Assembly, factorisation and two solves of a square film of m × m cells.
void time_lamellae() {
  double last_seconds = 0, last_unknowns = 0;
  for (int m : {12, 17, 24, 34, 48, 68, 96, 136, 192}) {
    auto network = verification::uniform_network(verification::rectangle(1e-3, 1e-3, m, m), 1e-6, 0);
    for (std::size_t d = 0; d < network.half_thickness.size(); ++d)
      network.half_thickness[d] *= 1 + 0.3 * std::sin(0.01 * static_cast<double>(d));
    drainage::DrainageEquations equations(network, verification::fig15_materials());
    const drainage::Unknowns y = equations.read(network);
    drainage::Unknowns k;
    const double unknowns = static_cast<double>(y.film.size());
    const int repetitions = std::max(3, static_cast<int>(1e5 / unknowns));
    const double begun = processor_time();
    for (int n = 0; n < repetitions; ++n) {
      equations.linearise(y, k);
      equations.factorise(1);
      equations.solve(k);
      equations.rates(y, k);
      equations.solve(k);
    }
    const double seconds = (processor_time() - begun) / repetitions;
    std::printf("film of %6.0f unknowns: %.3e s a step", unknowns, seconds);
    if (last_seconds > 0)
      std::printf(", power %.2f", std::log(seconds / last_seconds) / std::log(unknowns / last_unknowns));
    std::printf("\n");
    last_seconds = seconds;
    last_unknowns = unknowns;
  }
}

/// Steps of either scheme on four borders between two junctions, without their sources.
void time_borders() {
  for (int n = 8; n <= 2048; n *= 2) {
    const int steps = std::max(n, (1 << 17) / n);
    const double positive = verification::positive_border_error(n, steps).seconds / steps;
    const double published = verification::published_border_error(n, 4 * steps).seconds / (4 * steps);
    std::printf("four borders of %4d edges: %.3e s a step, published scheme %.3e s, ratio %.2f\n", n,
                positive, published, positive / published);
  }
}

}  // namespace

int main(int argc, char** argv) {
  const parallel::Session session(argc, argv);
  CLI::App program("Drainage of the foam of Fig. 15", "bench_drainage");
  std::vector<int> triangles{20000, 200000};
  program.add_option("--triangles", triangles, "of the meshes, about");
  bool lamellae = false;
  program.add_flag("--lamellae", lamellae, "time single lamellae instead");
  bool borders = false;
  program.add_flag("--borders", borders, "time borders by themselves instead, in steps of both schemes");
  CLI11_PARSE(program, argc, argv);
  if (borders) {
    time_borders();
    return 0;
  }
  if (lamellae) {
    time_lamellae();
    return 0;
  }
  double last_seconds = 0, last_triangles = 0;
  for (const int n : triangles) {
    const auto network = cluster(n);
    const Run run = drain(network);
    const StageTimes times = shares(network, run.steps);
    if (!world().is_root()) continue;
    const double size = network.mesh.n_triangles();
    const double imbalance = drainage::LamellaShares(network.topology, world()).imbalance();
    std::printf("%d ranks, %d lamellae; the first to the last of them, unknowns:", world().size(),
                network.topology.n_lamellae());
    std::vector<int> unknowns(network.topology.n_lamellae(), 0);
    for (const auto& dof : network.topology.film_dof) ++unknowns[dof.lamella];
    for (const int count : unknowns) std::printf(" %d", count);
    std::printf("; largest share of the work over the mean %.3f\n", imbalance);
    std::printf(
        "%d triangles, %zu unknowns of films: %.2f s of wall, %.2f s of processor time, %d steps and %d "
        "rejected, ledger %.1e\n",
        network.mesh.n_triangles(), network.half_thickness.size(), run.seconds, run.processor_seconds,
        run.outcome.n_steps, run.outcome.n_rejected, run.outcome.ledger_error);
    if (last_seconds > 0)
      std::printf("  growth of processor time with triangles: power %.2f\n",
                  std::log(run.processor_seconds / last_seconds) / std::log(size / last_triangles));
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
