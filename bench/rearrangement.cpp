// Seconds a step of the rearrangement, the share of each part, and the ratio to one Poisson solve of the same
// grid timed in the same run: machines differ and drift, ratios less so.  Usage: bench_rearrangement [cells a
// side = 64] [steps = 60]
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <map>
#include <string>

#include "spume/flow/navier_stokes.hpp"
#include "spume/flow/surface_tension.hpp"
#include "spume/interface/carry.hpp"
#include "spume/parallel/session.hpp"
#include "spume/simulation/film_update.hpp"
#include "spume/simulation/initial_foam.hpp"

namespace {

using namespace spume;

double now() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

class Stopwatch {
 public:
  template <class Work>
  void time(const std::string& part, Work&& work) {
    const double start = now();
    work();
    seconds_[part] += now() - start;
  }
  const std::map<std::string, double>& seconds() const { return seconds_; }

 private:
  std::map<std::string, double> seconds_;
};

simulation::Case cluster_case(int cells, int bubbles) {
  simulation::Case run_case;
  const double half = bubbles > 4 ? 8e-3 : 6e-3;
  run_case.box = {{-half, -half, -half}, {half, half, half}, {cells, cells, cells}};
  run_case.materials.gas = {1.2, 1.8e-5};
  run_case.materials.film.surface_tension = 0.03;
  run_case.foam.cluster = simulation::ClusterShape{
      .count = bubbles, .mean_diameter = 3e-3, .spread = 0.15, .seed = 1, .center = {}};
  return run_case;
}

/// The fastest of several Poisson solves by one transform pair [s].
double poisson_seconds(const grid::Grid& grid) {
  grid::Field f(grid), x(grid);
  for (std::size_t c = 0; c < f.values().size(); ++c) f.values()[c] = static_cast<double>(c * 7919 % 1013);
  grid::EllipticSolver solver(grid, grid::EllipticBackend::Trigonometric);
  solver.solve(0, 1, f, x);
  double fastest = 1e300;
  for (int n = 0; n < 11; ++n) {
    const double start = now();
    solver.solve(0, 1, f, x);
    fastest = std::min(fastest, now() - start);
  }
  return fastest;
}

void bench(int cells, int bubbles, int steps) {
  const simulation::Case run_case = cluster_case(cells, bubbles);
  const grid::Grid grid(parallel::Communicator::world(), run_case.box);
  state::Foam foam(grid);
  std::vector<state::Event> events;
  simulation::make_initial_foam(run_case, foam, events);

  const double poisson = poisson_seconds(grid);
  const double h = grid.h();
  const double dt = flow::capillary_limit(h, run_case.materials).dt;
  const grid::KernelCoupling kernel;
  flow::NavierStokes gas(grid, run_case.materials.gas, run_case.flow);
  grid::VectorField force(grid);
  mesh::Topology topology = mesh::build_topology(foam.films);
  std::vector<Vec3> reference = foam.films.position;
  int reconstructions = 0;
  Stopwatch watch;
  for (int step = 0; step < steps; ++step) {
    flow::FilmForces forces;
    watch.time("film forces", [&] {
      forces = flow::film_forces(foam.films, topology, foam.phases.count(),
                                 run_case.materials.film.surface_tension);
    });
    watch.time("spreading", [&] { flow::spread_film_forces(foam.films, forces, kernel, force); });
    watch.time("gas", [&] { gas.step(foam.gas, force, dt); });
    watch.time("moving films", [&] { interface::carry(foam.films, foam.gas.velocity, kernel, dt); });
    watch.time("young films", [&] {
      transport::fill_young_films(foam.films, topology, foam.liquid, h, run_case.transport);
    });
    double motion = 0;
    for (std::size_t v = 0; v < reference.size(); ++v)
      motion = std::max(motion, norm(foam.films.position[v] - reference[v]));
    if (motion > h || step == steps - 1) {
      watch.time("reconstruction",
                 [&] { topology = simulation::reconstruct_films(grid, run_case, foam).topology; });
      reference = foam.films.position;
      ++reconstructions;
    }
  }

  double total = 0;
  for (const auto& [part, seconds] : watch.seconds()) total += seconds;
  const double n_cells = static_cast<double>(grid.total_size());
  std::printf("\n%d^3 cells, %d bubbles, %d triangles, %d steps, %d reconstructions (%.3f s each)\n", cells,
              bubbles, foam.films.n_triangles(), steps, reconstructions,
              watch.seconds().at("reconstruction") / reconstructions);
  std::printf("  one Poisson solve  %9.5f s\n", poisson);
  std::printf("  a step             %9.5f s = %.0f Poisson solves; %.3g cells*steps/s\n", total / steps,
              total / steps / poisson, n_cells * steps / total);
  for (const auto& [part, seconds] : watch.seconds())
    std::printf("    %-16s %9.5f s  %5.1f %%\n", part.c_str(), seconds / steps, 100 * seconds / total);
}

}  // namespace

int main(int argc, char** argv) {
  const int cells = argc > 1 ? std::atoi(argv[1]) : 64;
  const int steps = argc > 2 ? std::atoi(argv[2]) : 60;
  parallel::Session session(argc, argv);
  for (int bubbles : {4, 12}) bench(cells, bubbles, steps);
}
