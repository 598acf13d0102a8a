#include "spume/drainage/lamella.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <string>

#include "networks.hpp"
#include "spume/base/error.hpp"

namespace spume::drainage {
namespace {

const state::Materials soap = {
    .gas = {}, .liquid = {1000, 1e-3}, .film = {0.034}, .gravity = {1.0, -2.0, -9.0}};

std::vector<double> rates(const LamellaDomain& lamella, const std::vector<double>& eta,
                          const state::Materials& materials, const std::vector<double>& outflow = {}) {
  std::vector<double> potential(eta.size()), rate(eta.size(), 0.0);
  lamella_potential(lamella, eta, materials, potential);
  add_lamella_flow(lamella, eta, potential, rate);
  if (!outflow.empty()) add_boundary_outflow(lamella, outflow, rate);
  return rate;
}

/// Decay rate of η₀ (1 + ε c), c = cos(πx/L) cos(πy/L), on a flat square film without gravity: −(c, η')/(εη₀
/// (c, c)) with the lumped scalar product. (Node by node the lumped mass is right only where six triangles
/// meet.)
double decay_rate(int n) {
  const double side = 1e-3, eta0 = 5e-6, amplitude = 1e-6;
  const auto network = testing::square_film(side, n, eta0);
  const auto lamella = build_lamella_domains(network, {}, {}, {0}).front();
  std::vector<double> eta, mode;
  for (const Vec3& x : network.mesh.position) {
    mode.push_back(std::cos(std::numbers::pi * x.x / side) * std::cos(std::numbers::pi * x.y / side));
    eta.push_back(eta0 * (1 + amplitude * mode.back()));
  }
  const std::vector<double> rate = rates(lamella, eta, soap);
  double decay = 0, size = 0;
  for (int i = 0; i < lamella.size(); ++i) {
    decay -= mode[i] * rate[i];
    size += lamella.surface.mass[i] * mode[i] * mode[i];
  }
  return decay / (eta0 * amplitude * size);
}

TEST(LamellaFlow, damps_a_mode_of_a_flat_film_at_sigma_eta_cubed_k4_over_3_mu_to_second_order) {
  const double k2 = 2 * std::pow(std::numbers::pi / 1e-3, 2);
  const double exact = 0.034 * std::pow(5e-6, 3) / (3 * 1e-3) * k2 * k2;
  const double coarse = std::abs(decay_rate(16) - exact), fine = std::abs(decay_rate(32) - exact);
  EXPECT_LT(fine, 0.01 * exact);
  EXPECT_NEAR(std::log2(coarse / fine), 2, 0.05);
}

TEST(LamellaFlow, leaves_a_uniform_film_on_a_sphere_at_rest_without_gravity) {
  const auto network = testing::single_bubble(1e-3, 3, 5e-6);
  const auto lamella = build_lamella_domains(network, {}, {}, {0}).front();
  // What one unit of round-off in w would drive through an edge.
  const double scale = 0.034 / 3e-3 * 2e6 * 5e-6 * std::pow(5e-6, 3);
  for (double r : rates(lamella, network.half_thickness, soap)) EXPECT_NEAR(r, 0, 1e-14 * scale);
}

TEST(LamellaFlow, leaves_any_film_of_constant_potential_at_rest) {
  // The curvature term balances gravity node by node: k = (w₀ − (ρ/3μ) g·x + (σ/3μ)(Kη)/m)/((σ/3μ) η).
  auto network = testing::single_bubble(1e-3, 3, 5e-6);
  for (std::size_t d = 0; d < network.half_thickness.size(); ++d)
    network.half_thickness[d] *= 1 + 0.2 * std::sin(1e4 * network.mesh.position[d].x);
  auto lamella = build_lamella_domains(network, soap.gravity, {}, {0}).front();
  const auto& eta = network.half_thickness;
  std::vector<double> potential(eta.size());
  lamella_potential(lamella, eta, soap, potential);
  const double target = 2 * std::abs(potential[0]) + 1;
  for (int i = 0; i < lamella.size(); ++i)
    lamella.curvature_squared[i] += (target - potential[i]) / (0.034 / 3e-3 * eta[i]);
  const double scale = std::pow(6e-6, 3) * target;
  for (double r : rates(lamella, eta, soap)) EXPECT_NEAR(r, 0, 1e-11 * scale);
}

TEST(EdgeMobility, is_the_cube_for_equal_ends_and_vanishes_with_either) {
  EXPECT_NEAR(edge_mobility(3, 3).value, 27, 1e-14);
  EXPECT_EQ(edge_mobility(0, 3).value, 0);
  EXPECT_EQ(edge_mobility(3, 0).value, 0);
  const double a = 1.5, b = 0.4, d = 1e-5;
  EXPECT_NEAR(edge_mobility(a, b).slope_a,
              (edge_mobility(a + d, b).value - edge_mobility(a - d, b).value) / (2 * d), 1e-9);
  EXPECT_NEAR(edge_mobility(a, b).slope_b,
              (edge_mobility(a, b + d).value - edge_mobility(a, b - d).value) / (2 * d), 1e-9);
}

class LamellaJacobianOnACorner : public ::testing::Test {
 protected:
  LamellaJacobianOnACorner() : network_(testing::tetrahedral_corner({3e-4, 5e-4, 8e-4, 1.2e-3}, 3e-6, 3e-8)) {
    for (std::size_t d = 0; d < network_.half_thickness.size(); ++d) {
      network_.half_thickness[d] *= 1 + 0.5 * std::sin(3.0 * d);
      network_.curvature_squared[d] = 1e6 * (1 + 0.3 * std::cos(5.0 * d));
    }
    borders_ = build_border_network(network_, soap.gravity);
    sites_ = suction_sites(network_, borders_);
    lamella_ = build_lamella_domains(network_, soap.gravity, sites_, {0}).front();
    for (int d : lamella_.film_dof) eta_.push_back(network_.half_thickness[d]);
  }
  Suction suction_at(const std::vector<double>& eta) const {
    auto all = network_.half_thickness;
    for (int i = 0; i < lamella_.size(); ++i) all[lamella_.film_dof[i]] = eta[i];
    Suction result;
    evaluate_suction(sites_, all, std::vector<double>(borders_.size(), 3e-8), soap, result);
    return result;
  }
  std::vector<double> dense(const LamellaJacobian& jacobian) const {
    const int n = lamella_.size();
    std::vector<double> full(n * n, 0.0);
    for (int j = 0; j < n; ++j)
      for (int p = jacobian.column_offset()[j]; p < jacobian.column_offset()[j + 1]; ++p)
        full[jacobian.row()[p] * n + j] = jacobian.value()[p];
    return full;
  }
  LamellaJacobian evaluated() const {
    std::vector<double> potential(eta_.size());
    lamella_potential(lamella_, eta_, soap, potential);
    LamellaJacobian jacobian(lamella_);
    jacobian.evaluate(lamella_, eta_, potential, soap, suction_at(eta_).slope);
    return jacobian;
  }

  state::FilmNetwork network_;
  BorderNetwork borders_;
  std::vector<SuctionSite> sites_;
  LamellaDomain lamella_;
  std::vector<double> eta_;
};

TEST_F(LamellaJacobianOnACorner, is_the_derivative_of_the_rates) {
  const int n = lamella_.size();
  const std::vector<double> full = dense(evaluated());
  for (int j = 0; j < n; ++j) {
    const double d = 1e-5 * eta_[j];
    auto up = eta_, down = eta_;
    up[j] += d;
    down[j] -= d;
    const auto above = rates(lamella_, up, soap, suction_at(up).outflow);
    const auto below = rates(lamella_, down, soap, suction_at(down).outflow);
    const double scale = std::abs(full[j * n + j]);
    for (int i = 0; i < n; ++i) EXPECT_NEAR(full[i * n + j], (above[i] - below[i]) / (2 * d), 1e-7 * scale);
  }
}

TEST_F(LamellaJacobianOnACorner, has_columns_that_sum_to_half_of_the_suction_slope) {
  const int n = lamella_.size();
  const std::vector<double> full = dense(evaluated());
  const Suction suction = suction_at(eta_);
  std::vector<double> expected(n, 0.0);
  for (const RimNode& node : lamella_.rim) expected[node.unknown] = -0.5 * suction.slope[node.site];
  for (int j = 0; j < n; ++j) {
    double sum = 0;
    for (int i = 0; i < n; ++i) sum += full[i * n + j];
    EXPECT_NEAR(sum, expected[j], 1e-13 * std::abs(full[j * n + j]));
  }
}

TEST(LamellaDomains, say_where_a_film_has_no_area) {
  auto network = testing::square_film(1e-3, 2, 1e-6);
  for (Vec3& x : network.mesh.position) x.y = 0.125;
  EXPECT_THROW(build_lamella_domains(network, {}, {}, {0}), NumericalError);
  try {
    build_lamella_domains(network, {}, {}, {0});
  } catch (const NumericalError& error) {
    EXPECT_NE(std::string(error.what()).find("0.125"), std::string::npos) << error.what();
  }
}

}  // namespace
}  // namespace spume::drainage
