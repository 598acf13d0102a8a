#include "spume/drainage/suction.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <numeric>

#include "networks.hpp"
#include "spume/drainage/lamella.hpp"

namespace spume::drainage {
namespace {

state::Materials soap() {
  state::Materials materials;
  materials.film.surface_tension = 0.034;
  return materials;
}

TEST(Suction, is_half_sigma_eta_to_five_halves_over_mu_r_to_three_halves) {
  const double r = 0.3e-3, eta = 2e-6;
  const double lambda = (std::numbers::sqrt3 - std::numbers::pi / 2) * r * r;
  const double exact = 0.5 * 0.034 * std::pow(eta, 2.5) / (1e-3 * std::pow(r, 1.5));
  EXPECT_NEAR(suction(eta, lambda, soap()), exact, 1e-14 * exact);
}

TEST(Suction, slope_is_the_derivative_by_eta) {
  const double eta = 1.3e-6, lambda = 4e-8, d = 1e-4 * eta;
  const double difference = (suction(eta + d, lambda, soap()) - suction(eta - d, lambda, soap())) / (2 * d);
  EXPECT_NEAR(suction_slope(eta, lambda, soap()), difference,
              1e-8 * difference);  // error of the difference: (d/η)²/8
}

TEST(SuctionSites, touch_each_border_along_its_whole_length_with_three_films) {
  const double edge = 1e-3;
  const auto network = testing::tetrahedral_corner({0.25 * edge, 0.5 * edge, edge}, 1e-6, 1e-8);
  const BorderNetwork borders = build_border_network(network, {});
  const auto sites = suction_sites(network, borders);
  const double length = std::accumulate(sites.begin(), sites.end(), 0.0,
                                        [](double sum, const auto& s) { return sum + s.length; });
  EXPECT_NEAR(length, 3 * 4 * edge, 1e-14 * edge);
  EXPECT_EQ(sites.size(), 3 * 4 * 3 + 6u);  // three films at each border vertex, six at the junction
  for (std::size_t n = 1; n < sites.size(); ++n) EXPECT_LT(sites[n - 1].film_dof, sites[n].film_dof);
}

TEST(SuctionSites, give_to_the_borders_what_they_take_from_the_films) {
  auto network = testing::tetrahedral_corner({3e-4, 6e-4, 1e-3}, 1e-6, 1e-8);
  for (std::size_t d = 0; d < network.half_thickness.size(); ++d)
    network.half_thickness[d] *= 1 + 0.1 * (d % 5);
  const BorderNetwork borders = build_border_network(network, {});
  const auto sites = suction_sites(network, borders);
  Suction result;
  evaluate_suction(sites, network.half_thickness, std::vector<double>(borders.size(), 1e-8), soap(), result);
  std::vector<double> inflow(borders.size(), 0.0), film_rate(network.half_thickness.size(), 0.0);
  add_border_source(sites, result.outflow, inflow);
  std::vector<int> all(network.topology.n_lamellae());
  std::iota(all.begin(), all.end(), 0);
  for (const LamellaDomain& lamella : build_lamella_domains(network, {}, sites, all)) {
    std::vector<double> rate(lamella.size(), 0.0);
    add_boundary_outflow(lamella, result.outflow, rate);
    for (int i = 0; i < lamella.size(); ++i) film_rate[lamella.film_dof[i]] += rate[i];
  }
  const double gained = std::accumulate(inflow.begin(), inflow.end(), 0.0);
  const double lost = -2 * std::accumulate(film_rate.begin(), film_rate.end(), 0.0);
  EXPECT_GT(gained, 0);
  EXPECT_NEAR(gained, lost, 1e-14 * gained);
}

}  // namespace
}  // namespace spume::drainage
