#include "spume/drainage/drain.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "networks.hpp"
#include "spume/base/error.hpp"

namespace spume::drainage {
namespace {

const state::Materials soap = {.gas = {}, .liquid = {1000, 1e-3}, .film = {0.034}, .gravity = {0, 0, -9.8}};

state::FilmNetwork corner() {
  return testing::tetrahedral_corner({0.6e-4, 1.2e-4, 2e-4, 3e-4, 4.5e-4, 6.5e-4, 1e-3}, 5e-6, 2e-8);
}
state::FilmNetwork ring() {
  return testing::double_bubble(1e-3, {0.3, 0.55, 0.75, 0.9, 1}, 16, 5e-6, 2e-8);
}

double least(const state::FilmNetwork& network) {
  double value = testing::thinnest_node(network).half_thickness;
  for (const auto& dof : network.topology.border_dof)
    value = std::min(value, network.border_area[dof.vertex]);
  return value;
}
double liquid(const state::FilmNetwork& network) {
  double sum = 0;
  for (int t = 0; t < network.mesh.n_triangles(); ++t)
    for (int dof : network.topology.corner_dof[t])
      sum += 2 * mesh::triangle_area(network.mesh, t) / 3 * network.half_thickness[dof];
  for (const auto& edge : network.topology.border_edge)
    for (int v : edge.vertex)
      sum += 0.5 * norm(network.mesh.position[edge.vertex[1]] - network.mesh.position[edge.vertex[0]]) *
             network.border_area[v];
  return sum;
}

TEST(Drain, keeps_the_liquid_and_stays_positive_from_the_beginning_to_the_end) {
  for (auto network : {corner(), ring()}) {
    const double before = liquid(network);
    int n_steps = 0;
    const auto outcome =
        drain(network, soap, {.max_time = 16, .tolerance = 0.02, .max_step = 10}, 0, testing::thinnest_node,
              [&](const DrainageProgress& progress, const auto& now) {
                EXPECT_GT(least(now), 0);
                EXPECT_EQ(progress.n_steps, ++n_steps);
                return true;
              });
    EXPECT_EQ(outcome.ending, Ending::Drained);
    EXPECT_EQ(outcome.elapsed, 16);
    EXPECT_EQ(outcome.n_steps, n_steps);
    EXPECT_LT(outcome.n_steps, 120);
    EXPECT_LT(std::abs(outcome.ledger_error), 1e-13);
    EXPECT_NEAR(liquid(network), before, 1e-13 * before);  // summed here, not by the scheme
    EXPECT_LT(testing::thinnest_node(network).half_thickness, 5e-8);
  }
}

TEST(Drain, respects_the_first_step_the_largest_step_and_the_end) {
  auto network = ring();
  const double r_squared = 2e-8 / 0.161254480774;
  const double cap = 0.02 * 3e-3 * r_squared / (0.034 * 5e-6), max_step = 0.01;
  double longest = 0, total = 0;
  const auto outcome = drain(network, soap, {.max_time = 0.25, .tolerance = 0.05, .max_step = max_step}, 0,
                             testing::thinnest_node, [&](const DrainageProgress& progress, const auto&) {
                               if (progress.n_steps == 1) {
                                 EXPECT_LE(progress.step, cap * (1 + 1e-9));
                               }
                               longest = std::max(longest, progress.step);
                               total += progress.step;
                               return true;
                             });
  EXPECT_EQ(outcome.elapsed, 0.25);
  EXPECT_NEAR(total, 0.25, 1e-13);
  EXPECT_EQ(longest, max_step);
}

TEST(Drain, stops_when_told_to_in_the_state_just_accepted) {
  auto network = ring();
  std::vector<double> seen;
  const auto outcome = drain(network, soap, {}, 1e-9, testing::thinnest_node,
                             [&](const DrainageProgress& progress, const auto& now) {
                               seen = now.half_thickness;
                               return progress.n_steps < 3;
                             });
  EXPECT_EQ(outcome.ending, Ending::Stopped);
  EXPECT_EQ(outcome.n_steps, 3);
  EXPECT_EQ(network.half_thickness, seen);
}

TEST(Drain, ruptures_just_below_the_threshold_at_a_time_that_hardly_depends_on_the_tolerance) {
  const double threshold = 5e-8;
  const auto rupture_time = [&](double tolerance) {
    auto network = ring();
    std::string last_limit;
    const auto outcome =
        drain(network, soap, {.max_time = 100, .tolerance = tolerance, .max_step = 10}, threshold,
              testing::thinnest_node, [&](const DrainageProgress& progress, const auto&) {
                last_limit = progress.limited_by;
                return true;
              });
    EXPECT_EQ(outcome.ending, Ending::Ruptured);
    EXPECT_EQ(last_limit, "rupture");
    EXPECT_LT(outcome.thinnest.half_thickness, threshold);
    EXPECT_GT(outcome.thinnest.half_thickness, 0.99 * threshold);  // a step is cut until η is within 1 %
    EXPECT_EQ(network.half_thickness[outcome.thinnest.film_dof], outcome.thinnest.half_thickness);
    EXPECT_LT(std::abs(outcome.ledger_error), 1e-13);
    return outcome.elapsed;
  };
  const double reference = rupture_time(0.001);
  EXPECT_NEAR(rupture_time(0.02), reference, 0.03 * reference);
  EXPECT_NEAR(rupture_time(0.04), reference, 0.03 * reference);
}

TEST(Drain, ruptures_at_once_where_a_film_is_too_thin_already) {
  auto network = ring();
  network.half_thickness[7] = 1e-8;
  const auto before = network.half_thickness;
  const auto outcome = drain(network, soap, {}, 2e-8, testing::thinnest_node, {});
  EXPECT_EQ(outcome.ending, Ending::Ruptured);
  EXPECT_EQ(outcome.elapsed, 0);
  EXPECT_EQ(outcome.thinnest.film_dof, 7);
  EXPECT_EQ(network.half_thickness, before);
}

TEST(Drain, does_not_rupture_where_no_point_counts) {
  auto network = ring();
  const auto nowhere = [](const state::FilmNetwork&) { return state::ThinPoint{}; };
  const auto outcome = drain(network, soap, {.max_time = 0.1}, 1, nowhere, {});
  EXPECT_EQ(outcome.ending, Ending::Drained);
  EXPECT_EQ(outcome.elapsed, 0.1);
}

TEST(Drain, is_the_same_to_the_last_bit_when_repeated) {
  auto first = corner(), second = corner();
  drain(first, soap, {.max_time = 1}, 0, testing::thinnest_node, {});
  drain(second, soap, {.max_time = 1}, 0, testing::thinnest_node, {});
  EXPECT_EQ(first.half_thickness, second.half_thickness);
  EXPECT_EQ(first.border_area, second.border_area);
}

void expect_failure(state::FilmNetwork network, const DrainageParameters& parameters,
                    const std::string& word) {
  try {
    drain(network, soap, parameters, 0, testing::thinnest_node, {});
    FAIL() << "no error";
  } catch (const NumericalError& error) {
    EXPECT_NE(std::string(error.what()).find(word), std::string::npos) << error.what();
    EXPECT_NE(std::string(error.what()).find(") m"), std::string::npos) << "says where: " << error.what();
  }
}

TEST(Drain, says_where_a_film_or_border_cannot_be_drained) {
  auto network = ring();
  network.half_thickness[20] = std::numeric_limits<double>::quiet_NaN();
  expect_failure(network, {}, "half-thickness nan");
  network = ring();
  network.half_thickness[20] = -1e-9;
  expect_failure(network, {}, "half-thickness -1e-09");
  network = ring();
  network.border_area[3] = 0;
  expect_failure(network, {}, "Plateau border");
  network = ring();
  network.mesh.position[5] = network.mesh.position[4];
  expect_failure(network, {}, "no ");
}

TEST(Drain, gives_up_and_says_where_when_no_step_is_good_enough) {
  expect_failure(ring(), {.max_time = 100, .tolerance = 1e-18, .max_step = 10}, "stalled");
}

TEST(Drain, refuses_absurd_parameters) {
  auto network = ring();
  EXPECT_THROW(drain(network, soap, {.tolerance = 0}, 0, testing::thinnest_node, {}), InputError);
  state::Materials ice = soap;
  ice.liquid.viscosity = 0;
  EXPECT_THROW(drain(network, ice, {}, 0, testing::thinnest_node, {}), InputError);
}

}  // namespace
}  // namespace spume::drainage
