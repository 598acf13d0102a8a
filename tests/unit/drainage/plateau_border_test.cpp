#include "spume/drainage/plateau_border.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "networks.hpp"
#include "spume/drainage/constants.hpp"

namespace spume::drainage {
namespace {

const state::Materials soap = {.gas = {}, .liquid = {1000, 1e-3}, .film = {0.034}, .gravity = {0, 0, -9.8}};

BorderFlux flux(double a, double b, const BorderLink& link) {
  return border_flux(border_root(a), border_root(b), link, soap);
}

TEST(BorderFlux, is_zero_exactly_where_the_border_is_hydrostatic) {
  // λ^{−1/2} rises by ρ g Δz/(2 C₁) along an edge that climbs Δz. Round-off: of the difference of two
  // λ^{−1/2}.
  const double rise = 1e-4, c1 = border_tension(0.034);
  const double a = 5e-8, b = std::pow(1 / std::sqrt(a) + 1000 * 9.8 * rise / (2 * c1), -2);
  const BorderLink link{{0, 1}, 2e-4, -9.8 * rise};
  const BorderLink without_gravity{{0, 1}, 2e-4, 0};
  const double free_flux = flux(a, b, without_gravity).value;
  EXPECT_GT(std::abs(free_flux), 0);
  EXPECT_NEAR(flux(a, b, link).value, 0, 1e-13 * std::abs(free_flux));
}

TEST(BorderFlux, of_tension_alone_is_the_integral_of_the_root_however_much_the_area_varies) {
  const BorderLink level{{0, 1}, 2e-4, 0};
  const double a = 1e-8, b = 7e-8, c1 = border_tension(0.034);
  const double integral = 2.0 / 3.0 * (std::pow(b, 1.5) - std::pow(a, 1.5));  // of √λ dλ
  const double exact = -border_flow / 1e-3 * c1 * integral / 2e-4;
  EXPECT_NEAR(flux(a, b, level).value, exact, 1e-14 * std::abs(exact));
}

TEST(BorderFlux, of_a_uniform_vertical_border_is_the_flow_under_gravity) {
  const BorderLink downwards{{0, 1}, 1e-4, 9.8e-4};
  const double lambda = 3e-8, exact = border_flow / 1e-3 * lambda * lambda * 1000 * 9.8;
  EXPECT_NEAR(flux(lambda, lambda, downwards).value, exact, 1e-14 * exact);
}

TEST(BorderFlux, slopes_are_the_derivatives) {
  const BorderLink link{{0, 1}, 1e-4, -3e-4};
  const double a = 3e-8, b = 3.4e-8, d = 1e-5 * a;
  const BorderFlux at = flux(a, b, link);
  const auto value = [&](double a1, double b1) { return flux(a1, b1, link).value; };
  const double by_a = (value(a + d, b) - value(a - d, b)) / (2 * d);
  const double by_b = (value(a, b + d) - value(a, b - d)) / (2 * d);
  EXPECT_NEAR(at.slope[0], by_a, 1e-8 * std::abs(by_a));
  EXPECT_NEAR(at.slope[1], by_b, 1e-8 * std::abs(by_b));
}

TEST(BorderFlux, slopes_of_tension_alone_are_exact_even_if_the_ends_differ_by_twelve_orders) {
  // The flux is that integral: its derivatives are the values of the root at both ends. Round-off alone.
  const BorderLink level{{0, 1}, 2e-4, 0};
  const double b = 1e-8, conductance = border_flow / 1e-3 * border_tension(0.034) / 2e-4;
  for (const double ratio : {1e-12, 1e-9, 1e-3, 1.0, 1e3, 1e9, 1e12}) {
    const double by_a = conductance * std::sqrt(ratio * b), by_b = -conductance * std::sqrt(b);
    const BorderFlux at = flux(ratio * b, b, level);
    EXPECT_NEAR(at.slope[0], by_a, 1e-14 * by_a) << ratio;
    EXPECT_NEAR(at.slope[1], by_b, 1e-14 * -by_b) << ratio;
  }
}

TEST(BorderFlux, slopes_are_those_of_mobility_times_drive_with_gravity_too) {
  // The product differentiated as it stands, in long double, of which the largest ratio cancels six digits.
  using Real = long double;
  const BorderLink link{{0, 1}, 1e-4, -3e-4};
  const Real c1 = border_tension(0.034), conductance = border_flow / (3 * 1e-3L * 1e-4L);
  const auto slope_by_first = [&](Real a, Real b, Real weight) {
    const Real r = std::sqrt(a), t = std::sqrt(b);
    const Real mobility = r * t * (a + r * t + b);
    const Real by_a = (3 * a * t + 2 * r * b + b * t) / (2 * r);
    return conductance * (by_a * (2 * c1 * (1 / t - 1 / r) + weight) + mobility * c1 / (a * r));
  };
  const Real weight = 1000 * -3e-4L;
  for (const double ratio : {1e-4, 1e-2, 0.5, 1.0, 2.0, 1e2, 1e4}) {
    const double b = 1e-8, a = ratio * b;
    const BorderFlux at = flux(a, b, link);
    const auto by_a = static_cast<double>(slope_by_first(a, b, weight));
    const auto by_b = static_cast<double>(-slope_by_first(b, a, -weight));  // the edge the other way round
    EXPECT_NEAR(at.slope[0], by_a, 1e-12 * std::abs(by_a)) << ratio;
    EXPECT_NEAR(at.slope[1], by_b, 1e-12 * std::abs(by_b)) << ratio;
  }
}

TEST(BorderFlux, approximates_the_continuous_flux_to_second_order) {
  // λ(ℓ) = λ₀ (1 + ε sin qℓ) on a vertical border: (C_Δ/μ)(−C₁ λ^{1/2} λ' + λ² ρ g_τ) at the middle of the
  // edge.
  const double lambda0 = 4e-8, q = 2e3, middle = 3e-4, g_tau = 9.8, c1 = border_tension(0.034);
  const auto lambda = [&](double l) { return lambda0 * (1 + 0.3 * std::sin(q * l)); };
  const double here = lambda(middle), slope = lambda0 * 0.3 * q * std::cos(q * middle);
  const double exact = border_flow / 1e-3 * (-c1 * std::sqrt(here) * slope + here * here * 1000 * g_tau);
  const auto error = [&](double h) {
    const BorderLink link{{0, 1}, h, g_tau * h};
    return std::abs(flux(lambda(middle - h / 2), lambda(middle + h / 2), link).value - exact);
  };
  const double order = std::log2(error(1e-4) / error(5e-5));
  EXPECT_NEAR(order, 2, 0.1);
}

TEST(BorderNetwork, shares_one_unknown_among_the_four_borders_of_a_junction) {
  const auto network = testing::tetrahedral_corner({3e-4, 1e-3}, 1e-6, 1e-8);
  ASSERT_EQ(network.topology.n_junctions(), 1);
  const BorderNetwork borders = build_border_network(network, soap.gravity);
  EXPECT_EQ(borders.size(), 9);
  const int junction = borders.unknown_of_vertex[network.topology.junction[0]];
  const auto ends_there = [&](const BorderLink& link) {
    return link.unknown[0] == junction || link.unknown[1] == junction;
  };
  EXPECT_EQ(std::count_if(borders.link.begin(), borders.link.end(), ends_there), 4);
  EXPECT_NEAR(borders.length[junction], 4 * 3e-4 / 2, 1e-18);
}

TEST(BorderNetwork, at_a_junction_all_that_flows_in_flows_out_or_is_stored) {
  auto network = testing::tetrahedral_corner({3e-4, 6e-4, 1e-3}, 1e-6, 1e-8);
  const BorderNetwork borders = build_border_network(network, soap.gravity);
  std::vector<double> lambda, rate(borders.size(), 0.0);
  for (int u = 0; u < borders.size(); ++u) lambda.push_back(1e-8 * (1 + 0.3 * std::sin(7.0 * u)));
  std::vector<BorderRoot> root;
  evaluate_border_roots(lambda, root);
  add_border_flow(borders, root, soap, rate);
  double sum = 0, size = 0;
  for (double r : rate) {
    sum += r;
    size += std::abs(r);
  }
  EXPECT_GT(size, 0);
  EXPECT_NEAR(sum, 0, 1e-14 * size);
}

}  // namespace
}  // namespace spume::drainage
