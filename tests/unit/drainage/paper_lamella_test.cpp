#include "spume/drainage/paper_lamella.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <numeric>
#include <vector>

#include "networks.hpp"

namespace spume::drainage {
namespace {

const state::Materials soap = {.gas = {}, .liquid = {1000, 1e-3}, .film = {0.034}, .gravity = {3, -9, 0}};

LamellaSurface surface_of(const state::FilmNetwork& network, const Vec3& gravity_on_it) {
  LamellaSurface surface;
  for (const auto& dof : network.topology.film_dof)
    surface.position.push_back(network.mesh.position[dof.vertex]);
  surface.triangle = network.topology.corner_dof;
  surface.curvature_squared = network.curvature_squared;
  surface.tangential_gravity.assign(surface.position.size(), gravity_on_it);
  return surface;
}

/// Decay rate of a small mode on a flat square film in one short step.
double decay_rate(int n, double dt) {
  const double side = 1e-3, eta0 = 5e-6, amplitude = 1e-6;
  const auto network = testing::square_film(side, n, eta0);
  PaperLamella lamella(surface_of(network, {}), soap);
  std::vector<double> mode, eta;
  for (const Vec3& x : lamella.surface().position) {
    mode.push_back(std::cos(std::numbers::pi * x.x / side) * std::cos(std::numbers::pi * x.y / side));
    eta.push_back(eta0 * (1 + amplitude * mode.back()));
  }
  std::vector<double> weighted(eta.size(), 0.0);  // M mode
  lamella.integrate(mode, weighted);
  const auto size = [&] {
    double sum = 0;
    for (std::size_t i = 0; i < eta.size(); ++i) sum += weighted[i] * (eta[i] - eta0);
    return sum;
  };
  const double before = size();
  EXPECT_TRUE(lamella.advance(dt, std::vector<double>(eta.size(), 0.0), eta));
  return (1 - size() / before) / dt;
}

TEST(PaperLamella, damps_a_mode_of_a_flat_film_at_the_exact_rate_to_second_order) {
  const double k2 = 2 * std::pow(std::numbers::pi / 1e-3, 2);
  const double exact = 0.034 * std::pow(5e-6, 3) / 3e-3 * k2 * k2;
  const double dt = 1e-6 / exact;  // so short that the damping term does not matter
  const double coarse = std::abs(decay_rate(16, dt) - exact), fine = std::abs(decay_rate(32, dt) - exact);
  EXPECT_LT(fine, 0.02 * exact);
  EXPECT_NEAR(std::log2(coarse / fine), 2, 0.1);
}

TEST(PaperLamella, damping_slows_a_mode_as_the_semi_implicit_step_says) {
  // One step: 1 − r Δt/(1 + 2 r Δt), r the rate of the mode, since α = 2 η₀³ and the mass is consistent on
  // both sides. The mode is one of the discrete operators only to second order.
  const double k2 = 2 * std::pow(std::numbers::pi / 1e-3, 2);
  const double exact = 0.034 * std::pow(5e-6, 3) / 3e-3 * k2 * k2;
  const double dt = 0.5 / exact;
  EXPECT_NEAR(decay_rate(32, dt), exact / 2, 0.01 * exact);
}

TEST(PaperLamella, integrates_eta_cubed_times_gravity_exactly) {
  // σ = 0 on the square [0, L]²: Σ x_i (M η')_i = (ρ/3μ) g_x ∫ η³ with η = a + b x + c y.
  const double side = 1e-3, a = 4e-6, b = 2e-3, c = -1e-3, dt = 1e-9;
  state::Materials heavy = soap;
  heavy.film.surface_tension = 0;
  const auto network = testing::square_film(side, 5, a);
  PaperLamella lamella(surface_of(network, heavy.gravity), heavy);
  std::vector<double> eta, weight(lamella.n_nodes(), 0.0), x;
  for (const Vec3& p : lamella.surface().position) {
    eta.push_back(a + b * p.x + c * p.y);
    x.push_back(p.x);
  }
  const std::vector<double> before = eta;
  lamella.integrate(x, weight);
  ASSERT_TRUE(lamella.advance(dt, std::vector<double>(eta.size(), 0.0), eta));
  double moment = 0;
  for (std::size_t i = 0; i < eta.size(); ++i) moment += weight[i] * (eta[i] - before[i]) / dt;
  const auto fifth = [](double v) { return v * v * v * v * v; };
  const double integral =
      (fifth(a + b * side + c * side) - fifth(a + b * side) - fifth(a + c * side) + fifth(a)) / (20 * b * c);
  // η changes by 1e-10 of itself, so seven digits are left of its change.
  EXPECT_NEAR(moment, 1000 / 3e-3 * 3 * integral, 1e-5 * std::abs(moment));
}

TEST(PaperLamella, leaves_a_uniform_film_on_a_sphere_at_rest) {
  const auto network = testing::single_bubble(1e-3, 3, 5e-6);
  PaperLamella lamella(surface_of(network, {}), soap);
  std::vector<double> eta = network.half_thickness;
  ASSERT_TRUE(lamella.advance(1, std::vector<double>(eta.size(), 0.0), eta));
  for (double v : eta) EXPECT_NEAR(v, 5e-6, 1e-14 * 5e-6);
}

TEST(PaperLamella, keeps_the_liquid_but_for_what_is_supplied) {
  const auto network = testing::square_film(1e-3, 10, 5e-6);
  PaperLamella lamella(surface_of(network, soap.gravity), soap);
  std::vector<double> eta = network.half_thickness, load(eta.size(), 0.0);
  lamella.integrate(std::vector<double>(eta.size(), 1e-8), load);
  const double supplied = std::accumulate(load.begin(), load.end(), 0.0), before = lamella.liquid(eta);
  EXPECT_NEAR(supplied, 1e-14, 1e-26);
  // Steps of different length, so that the factors of one matrix serve another.
  double time = 0;
  for (int step = 0; step < 100; ++step) {
    const double dt = 1e-3 * (1 + 0.3 * std::sin(step));
    ASSERT_TRUE(lamella.advance(dt, load, eta));
    time += dt;
  }
  EXPECT_NEAR(lamella.liquid(eta), before + time * supplied, 1e-14 * before);
}

TEST(PaperLamella, says_so_when_eta_is_not_finite) {
  const auto network = testing::square_film(1e-3, 4, 5e-6);
  PaperLamella lamella(surface_of(network, {}), soap);
  std::vector<double> eta = network.half_thickness;
  eta[3] = std::nan("");
  eta[4] = INFINITY;
  EXPECT_FALSE(lamella.advance(1, std::vector<double>(eta.size(), 0.0), eta));
}

}  // namespace
}  // namespace spume::drainage
