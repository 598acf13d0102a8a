#include "spume/drainage/paper_border.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>
#include <vector>

#include "spume/base/error.hpp"
#include "spume/drainage/constants.hpp"

namespace spume::drainage {
namespace {

state::Materials unit_materials(double density = 1) {
  return {.gas = {}, .liquid = {density, 1}, .film = {1}, .gravity = {0, 0, -1}};
}

/// Four arms with λ and gravity along them.
std::vector<JunctionArm> arms_with(const std::vector<double>& lambda, const std::vector<double>& gravity) {
  std::vector<JunctionArm> arms;
  for (std::size_t n = 0; n < lambda.size(); ++n)
    arms.push_back({0.1 * (1 + 0.2 * n), 0.13, lambda[n], lambda[n] * 1.1, gravity[n]});
  return arms;
}

double sum_of_fluxes(const std::vector<JunctionArm>& arms, double lambda0) {
  double sum = 0;
  for (const auto& arm : arms) sum += junction_flux(arm, lambda0, unit_materials());
  return sum;
}

TEST(JunctionSlope, is_exact_for_a_parabola) {
  const double h0 = 0.3, h1 = 0.5;
  const auto lambda = [](double l) { return 2 + 3 * l - 4 * l * l; };
  EXPECT_NEAR(junction_slope({h0, h1, lambda(h0), lambda(h0 + h1), 0}, lambda(0)), 3, 1e-14);
}

TEST(JunctionArea, balances_the_fluxes_without_gravity_and_with_it_either_way) {
  for (const double g : {0.0, 0.7, -0.05}) {
    const auto arms = arms_with({1, 1.2, 0.9, 1.1}, {g, g, 0, 0});
    const auto lambda0 = junction_area(arms, unit_materials());
    ASSERT_TRUE(lambda0);
    // The terms of the sum are of order ten.
    EXPECT_NEAR(sum_of_fluxes(arms, *lambda0), 0, 1e-13);
    EXPECT_NEAR(*lambda0, 1, 0.3);
  }
}

TEST(JunctionArea, is_the_smaller_of_two_roots_where_gravity_pulls_towards_the_junction) {
  const auto arms = arms_with({1, 1, 1, 1}, {-0.3, -0.3, 0, 0});
  const auto lambda0 = junction_area(arms, unit_materials());
  ASSERT_TRUE(lambda0);
  for (double lambda = 1e-3; lambda < 0.999 * *lambda0; lambda += 1e-3)
    EXPECT_GT(sum_of_fluxes(arms, lambda), 0) << "a root below, near " << lambda;
  double beyond = *lambda0;
  while (sum_of_fluxes(arms, beyond * 1.01) < 0 && beyond < 1e6) beyond *= 1.01;
  EXPECT_LT(beyond, 1e6) << "the larger root";
}

TEST(JunctionArea, is_none_where_no_balance_exists) {
  EXPECT_FALSE(junction_area(arms_with({1, 1, 1, 1}, {-100, 0, 0, 0}), unit_materials()));
  auto steep = arms_with({1, 1, 1, 1}, {0, 0, 0, 0});
  for (auto& arm : steep) arm.lambda2 = 100;  // λ₀ would have to be negative
  EXPECT_FALSE(junction_area(steep, unit_materials()));
}

/// Four borders of n edges and different lengths between two junctions, gravity along three of them.
BorderCurves four_straight_borders(int n) {
  BorderCurves borders;
  borders.junction.resize(2);
  for (int c = 0; c < 4; ++c) {
    const double h = (1 + 0.3 * c) / n;
    borders.curve.push_back({std::vector<double>(n, h), std::vector<double>(n, 0.2 * (c - 1) * h), false});
    borders.junction[0].push_back({c, false});
    borders.junction[1].push_back({c, true});
  }
  return borders;
}

std::vector<double> uneven(int n) {
  std::vector<double> lambda;
  for (int i = 0; i < n; ++i) lambda.push_back(1 + 0.1 * std::sin(0.3 * i));
  return lambda;
}

TEST(PaperBorders, keep_the_liquid_but_for_what_is_supplied) {
  PaperBorders borders(four_straight_borders(12), unit_materials());
  std::vector<double> lambda = uneven(borders.n_nodes()), load(lambda.size(), 0.0);
  borders.project(lambda);
  borders.integrate(uneven(borders.n_nodes()), load);
  const double supplied = std::accumulate(load.begin(), load.end(), 0.0);
  EXPECT_NEAR(supplied, borders.liquid(uneven(borders.n_nodes())), 1e-14);
  const double before = borders.liquid(lambda), dt = 0.01;
  for (int step = 0; step < 100; ++step) {
    ASSERT_FALSE(borders.advance(dt, load, lambda));
    borders.project(lambda);
  }
  EXPECT_NEAR(borders.liquid(lambda), before + 100 * dt * supplied, 1e-13 * before);
}

TEST(PaperBorders, projection_shares_the_liquid_of_the_half_edges_at_a_junction) {
  const PaperBorders borders(four_straight_borders(5), unit_materials());
  std::vector<double> lambda = uneven(borders.n_nodes());
  const double before = borders.liquid(lambda);
  borders.project(lambda);
  EXPECT_NEAR(borders.liquid(lambda), before, 1e-14 * before);
  const auto offset = borders.offset();
  for (int c = 1; c < 4; ++c) {
    EXPECT_EQ(lambda[offset[c]], lambda[offset[0]]);
    EXPECT_EQ(lambda[offset[c + 1] - 1], lambda[offset[1] - 1]);
  }
}

TEST(PaperBorders, a_ring_relaxes_to_the_hydrostatic_profile) {
  // Height cos: ρ g per unit of length small enough that λ^{−1/2} stays positive.
  const int n = 64;
  BorderCurves borders;
  BorderCurve ring;
  ring.closed = true;
  const auto height = [](int i) { return 0.2 * std::cos(2 * std::numbers::pi * i / n); };
  for (int i = 0; i < n; ++i) {
    ring.length.push_back(2 * std::numbers::pi / n);
    ring.descent.push_back(height(i) - height(i + 1));
  }
  borders.curve.push_back(ring);
  PaperBorders scheme(borders, unit_materials());
  std::vector<double> lambda(n, 1.0);
  const std::vector<double> load(n, 0.0);
  for (int step = 0; step < 4000; ++step) ASSERT_FALSE(scheme.advance(0.5, load, lambda));
  const double slope =
      (1 / std::sqrt(lambda[0]) - 1 / std::sqrt(lambda[n / 2])) / (height(0) - height(n / 2));
  // The mean of λ² in an edge is not the hydrostatic one: second order, here 0.2 %.
  EXPECT_NEAR(slope, 1 / (2 * border_tension(1)), 0.004 * slope);
}

TEST(PaperBorders, tells_where_a_border_runs_dry) {
  PaperBorders borders(four_straight_borders(6), unit_materials());
  std::vector<double> lambda(borders.n_nodes(), 1.0), load(lambda.size(), 0.0);
  load[borders.offset()[2] + 3] = -1e3;
  const auto fault = borders.advance(0.01, load, lambda);
  ASSERT_TRUE(fault);
  EXPECT_EQ(fault->curve, 2);
  EXPECT_EQ(fault->node, 3);
  EXPECT_LT(fault->value, 0);
}

TEST(PaperBorders, refuse_a_border_of_one_edge_at_a_junction) {
  EXPECT_THROW(PaperBorders(four_straight_borders(1), unit_materials()), InputError);
}

}  // namespace
}  // namespace spume::drainage
