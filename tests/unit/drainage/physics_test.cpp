// Drainage against exact solutions and against an independent one-dimensional solution.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "networks.hpp"
#include "spume/drainage/constants.hpp"
#include "spume/drainage/drain.hpp"
#include "spume/drainage/step.hpp"

namespace spume::drainage {
namespace {

const state::Materials soap = {.gas = {}, .liquid = {1000, 1e-3}, .film = {0.034}, .gravity = {0, 0, -9.8}};

TEST(HydrostaticBorder, is_reached_from_a_uniform_one) {
  // A vertical ring between films too thin to feed it: λ^{−1/2} becomes linear in height with slope ρg/(2C₁).
  auto network = testing::double_bubble(2e-3, {0.5, 1}, 48, 1e-8, 5e-8);
  drain(network, soap, {.max_time = 60, .tolerance = 0.02, .max_step = 10}, 0, testing::thinnest_node, {});
  double n = 0, z = 0, y = 0, zz = 0, zy = 0;
  for (const auto& dof : network.topology.border_dof) {
    const double height = network.mesh.position[dof.vertex].z,
                 root = 1 / std::sqrt(network.border_area[dof.vertex]);
    n += 1;
    z += height;
    y += root;
    zz += height * height;
    zy += height * root;
  }
  const double slope = (n * zy - z * y) / (n * zz - z * z);
  const double exact = 1000 * 9.8 / (2 * border_tension(0.034));
  EXPECT_NEAR(slope, exact, 1e-3 * exact);
  const double offset = (y - slope * z) / n, range = exact * 4e-3;
  for (const auto& dof : network.topology.border_dof) {
    const double root = 1 / std::sqrt(network.border_area[dof.vertex]);
    EXPECT_NEAR(root, offset + slope * network.mesh.position[dof.vertex].z, 1e-3 * range);
  }
}

/// Largest relative error at the top and the bottom of a bubble whose film falls by its weight alone (σ = 0):
/// η = η₀ (1 ± 4ρgη₀²t/(3μR))^{−1/2}, + at the top, from η' = −η³ (ρ/3μ) ∇_s·g_s with ∇_s·g_s = ±2g/R.
double error_of_falling_film(int levels) {
  const double radius = 1e-3, eta0 = 5e-6, time = 1;
  state::Materials heavy = soap;
  heavy.film.surface_tension = 0;
  // Down is along a direction in which six triangles meet at the top and the bottom, which the four of the
  // octahedron's corners do not replace: there the lumped mass is not the area that the vertex stands for.
  const Vec3 up = normalized({1, 1, 0});
  heavy.gravity = -9.8 * up;
  auto network = testing::single_bubble(radius, levels, eta0);
  const auto outcome = drain(network, heavy, {.max_time = time, .tolerance = 0.002, .max_step = 0.1}, 0,
                             testing::thinnest_node, {});
  EXPECT_LT(std::abs(outcome.ledger_error), 1e-13);
  const double s = 4 * 1000 * 9.8 * eta0 * eta0 * time / (3e-3 * radius);
  double error = 0;
  for (int v = 0; v < network.mesh.n_vertices(); ++v) {
    const double z = dot(network.mesh.position[v], up) / radius;
    if (std::abs(z) < 1 - 1e-12) continue;
    error = std::max(error, std::abs(network.half_thickness[v] / eta0 * std::sqrt(1 + z * s) - 1));
  }
  return error;
}

TEST(FallingFilm, thins_at_the_top_and_thickens_at_the_bottom_of_a_single_bubble) {
  // The sphere's triangles are uneven, which leaves an error of 0.1 % whatever their size; second order is
  // tested on even ones (LamellaFlow).
  const double coarse = error_of_falling_film(2), fine = error_of_falling_film(3);
  EXPECT_LT(fine, 0.005);
  EXPECT_GT(coarse, 2 * fine);
}

/// η at the border of three flat films of half-width 0.5 mm, without gravity, λ held at 0.05 mm², at the
/// given times.
std::vector<double> rim_of_flat_strip(const std::vector<double>& distances,
                                      const std::vector<double>& times) {
  const double eta0 = 5e-6, lambda = 5e-8, tolerance = 0.02;
  const auto network = testing::three_strips(distances, 20e-6, eta0, lambda);
  state::Materials weightless = soap;
  weightless.gravity = {};
  DrainageEquations equations(network, weightless);
  Stepper stepper(equations);
  Unknowns y = equations.read(network);
  std::vector<double> rims;
  double t = 0, dt = 1e-4;
  for (double end : times) {
    while (t < end) {
      const double step = std::min(dt, end - t);
      stepper.start(y);
      const Trial& trial = stepper.attempt(Method::Rosenbrock, step);
      const double error = trial.error / tolerance;
      const bool accepted = trial.positive && error <= 1;
      dt = step * (trial.positive ? std::clamp(0.85 / std::sqrt(error), 0.2, 2.0) : 0.25);
      if (!accepted) continue;
      y = trial.y;
      std::fill(y.border.begin(), y.border.end(), lambda);
      t = step == end - t ? end : t + step;
    }
    // Both ends of the border and all three films: the diagonals of the cells make the ends differ by a few
    // per cent.
    double sum = 0;
    for (const SuctionSite& site : equations.sites()) sum += y.film[site.film_dof];
    rims.push_back(sum / static_cast<double>(equations.sites().size()));
  }
  return rims;
}

TEST(FlatStrip, has_the_rim_of_the_one_dimensional_solution) {
  // Finite differences with arithmetic mobility in one dimension down to h = 0.2 µm: 2.722, 1.055, 0.375 µm.
  std::vector<double> distances = {0};
  for (double h = 4e-6; distances.back() < 0.5e-3; h *= 1.15) distances.push_back(distances.back() + h);
  for (double& x : distances) x *= 0.5e-3 / distances.back();
  const std::vector<double> exact = {2.722e-6, 1.055e-6, 0.375e-6}, times = {0.01, 0.1, 1};
  const std::vector<double> rim = rim_of_flat_strip(distances, times);
  for (std::size_t n = 0; n < times.size(); ++n)
    EXPECT_NEAR(rim[n], exact[n], 0.02 * exact[n]) << "at " << times[n] << " s";
}

}  // namespace
}  // namespace spume::drainage
