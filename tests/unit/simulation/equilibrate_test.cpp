#include "spume/simulation/equilibrate.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "spume/interface/smooth_area.hpp"
#include "spume/mesh/measure.hpp"
#include "spume/mesh/quality.hpp"
#include "spume/simulation/initial_foam.hpp"

namespace spume::simulation {
namespace {

constexpr double h = 1e-4;  // cell [m]

Case empty_case(int cells) {
  Case run_case;
  const double half = 0.5 * cells * h;
  run_case.box = {{-half, -half, -half}, {half, half, half}, {cells, cells, cells}};
  run_case.materials.film.surface_tension = 0.03;
  return run_case;
}

Case random_foam_in_a_box() {
  Case run_case = empty_case(32);
  run_case.foam.lattice =
      LatticeShape{.structure = LatticeShape::Structure::Random, .count = 12, .spread = 0.2};
  return run_case;
}

struct Relaxed {
  state::Foam foam;
  EquilibrateReport report;
  double largest_rise = 0;  // of the area from one step to the next, relative
};

Relaxed relax(const grid::Grid& grid, const Case& run_case) {
  Relaxed result{state::Foam(grid), {}, 0};
  std::vector<state::Event> events;
  make_initial_foam(run_case, result.foam, events);
  double last = 1e300;
  result.report = equilibrate(grid, run_case, result.foam, events, [&](const auto& step, const auto&) {
    EXPECT_LE(step.area_after, step.area_before);
    result.largest_rise = std::max(result.largest_rise, step.area_after / last - 1);
    last = step.area_after;
    return true;
  });
  return result;
}

// Four spheres that overlap too little. The exact cluster of equal bubbles: A = 33.499028379 R² at
// V = 2.791585698 R³; the volumes found differ by 1e-3, which changes the area by less than 1e-6.
TEST(Equilibrate, finds_the_tetrahedral_cluster) {
  constexpr double radius = 8 * h;
  Case run_case = empty_case(44);
  const double a = 0.41 * radius;
  for (const Vec3& x : {Vec3{a, a, a}, {a, -a, -a}, {-a, a, -a}, {-a, -a, a}})
    run_case.foam.bubble.push_back({x + h * Vec3{0.137, 0.371, 0.219}, {radius, radius, radius}});
  const grid::Grid grid(parallel::Communicator::world(), run_case.box);
  const Relaxed relaxed = relax(grid, run_case);

  const mesh::Topology topology = mesh::build_topology(relaxed.foam.films);
  EXPECT_TRUE(relaxed.report.converged);
  EXPECT_LE(relaxed.report.n_reconstructions, 4);
  EXPECT_LT(relaxed.report.virial_error, 1e-4);
  EXPECT_EQ(topology.n_nonconforming_edges, 0);
  EXPECT_EQ(topology.n_borders(), 10);
  double volume = 0;
  for (int p = 1; p <= 4; ++p) volume += relaxed.foam.phases.target_volume[p];
  const double r = std::cbrt(volume / 4 / 2.791585698), exact = 33.499028379 * r * r;
  // 6e-5 and 6.4e-4 measured, both falling as h² or faster.
  EXPECT_NEAR(interface::smooth_film_area(relaxed.foam.films, topology, relaxed.foam.phases) / exact, 1,
              1e-4);
  EXPECT_NEAR(mesh::film_area(relaxed.foam.films) / exact, 1, 1e-3);
}

// Clusters of six have films between four borders that shrink below a cell. Of the first sixteen seeds these
// have the smallest such films on the way.
TEST(Equilibrate, leaves_no_tiny_edges_in_random_clusters) {
  for (std::uint64_t seed : {1, 2, 6, 8, 10, 16}) {
    Case run_case = empty_case(46);
    run_case.foam.cluster =
        ClusterShape{.count = 6, .mean_diameter = 11 * h, .spread = 0.2, .seed = seed, .center = {}};
    const grid::Grid grid(parallel::Communicator::world(), run_case.box);
    const Relaxed relaxed = relax(grid, run_case);
    const mesh::Topology topology = mesh::build_topology(relaxed.foam.films);
    const mesh::Quality quality = mesh::measure_quality(relaxed.foam.films, topology);
    EXPECT_TRUE(relaxed.report.converged) << "seed " << seed;
    EXPECT_EQ(topology.n_nonconforming_edges, 0) << "seed " << seed;
    EXPECT_GT(quality.shortest_edge, 0.2 * h) << "seed " << seed;
    EXPECT_GT(quality.smallest_angle_degrees, 15) << "seed " << seed;
    EXPECT_LT(relaxed.largest_rise, 1e-4) << "seed " << seed;  // by reconstructions; 4e-5 measured
  }
}

// In a foam that fills a box films change places one after the other, and soft modes decide how long it
// takes to rest. Without going ahead, and with a reconstruction for every poor triangle, it took 83 steps and
// 13 reconstructions here; 65 and 6 are measured now.
TEST(Equilibrate, takes_few_reconstructions_in_a_foam_that_fills_the_box) {
  const Case run_case = random_foam_in_a_box();
  const grid::Grid grid(parallel::Communicator::world(), run_case.box);
  const Relaxed relaxed = relax(grid, run_case);
  EXPECT_TRUE(relaxed.report.converged);
  EXPECT_LE(relaxed.report.n_reconstructions, 9);
}

// Films of uniform thickness stretch by what their areas grow, and films that are born are filled up to half
// of the mean: 0.33 of the thickness at the start is measured. Where vertices carry the liquid, a film that
// grows beside a T1 gets a hole of 0.022.
TEST(Equilibrate, draws_no_film_out_into_a_thin_spot) {
  const Case run_case = random_foam_in_a_box();
  const grid::Grid grid(parallel::Communicator::world(), run_case.box);
  const state::Foam foam = relax(grid, run_case).foam;
  const std::vector<double> area = mesh::film_dof_areas(foam.films, mesh::build_topology(foam.films));
  double thinnest = 1;
  for (std::size_t d = 0; d < area.size(); ++d)
    thinnest = std::min(thinnest, foam.liquid.lamella_volume[d] / (2 * area[d]));
  EXPECT_GT(thinnest, 0.25 * run_case.foam.lamella_half_thickness);
}

// Films whose bubbles hold a hundredth less than they should: more gas needs more area, and no step could
// lower it.
TEST(Equilibrate, gives_bubbles_their_gas_before_it_looks_for_less_area) {
  Case run_case = empty_case(28);
  run_case.foam.bubble.push_back({{}, {7 * h, 7 * h, 8 * h}});
  const grid::Grid grid(parallel::Communicator::world(), run_case.box);
  state::Foam foam(grid);
  std::vector<state::Event> events;
  make_initial_foam(run_case, foam, events);
  foam.phases.target_volume[1] *= 1.01;
  const auto report = equilibrate(grid, run_case, foam, events, [](const auto& step, const auto&) {
    EXPECT_LE(step.area_after, step.area_before);
    return true;
  });
  EXPECT_TRUE(report.converged);
  EXPECT_NEAR(mesh::phase_volumes(foam.films, 2)[1] / foam.phases.target_volume[1], 1, 1e-8);
}

TEST(Equilibrate, finds_a_foam_without_films_at_rest) {
  const Case run_case = empty_case(16);
  const grid::Grid grid(parallel::Communicator::world(), run_case.box);
  state::Foam foam(grid);
  std::vector<state::Event> events;
  const auto report = equilibrate(grid, run_case, foam, events, [](const auto&, const auto&) {
    ADD_FAILURE() << "no step to be taken";
    return true;
  });
  EXPECT_TRUE(report.converged);
  EXPECT_EQ(report.area_to_fall, 0);
  EXPECT_TRUE(events.empty());
}

}  // namespace
}  // namespace spume::simulation
