#include "spume/simulation/equilibrium.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace spume::simulation {
namespace {

constexpr double sigma = 0.03, area = 1e-4;

/// Feeds a damped oscillation of relative amplitude `amplitude` for `duration` periods of 1 s, 50 samples a
/// period.
EquilibriumMeasure after(double amplitude, double duration, double shrinking = 0, double virial = 1) {
  RearrangeState rearrange;
  EquilibriumMeasure measure;
  for (double t = 0; t <= duration + 1e-9; t += 0.02) {
    rearrange.elapsed = t;
    const double speed = amplitude * std::sin(2 * std::numbers::pi * t);
    measure =
        measure_equilibrium(rearrange, 1.0, 2 * sigma * area * speed * speed, area * (1 - shrinking * t),
                            virial + 0.1 * std::cos(2 * std::numbers::pi * t), sigma);
  }
  return measure;
}

TEST(Equilibrium, is_not_declared_before_a_whole_window_has_passed) {
  EXPECT_FALSE(after(0, 0.9).reached(0.01));
  EXPECT_TRUE(after(0, 1.1).reached(0.01));
}

// The kinetic energy passes through zero at t = 1.5 and 2: the window still sees its maximum.
TEST(Equilibrium, is_not_fooled_by_an_instant_of_rest) {
  EXPECT_NEAR(after(0.05, 1.5).amplitude, 0.05, 0.05 * 0.01);
  EXPECT_FALSE(after(0.05, 2.0).reached(0.01));
  EXPECT_TRUE(after(0.009, 2.0).reached(0.01));
}

TEST(Equilibrium, is_not_reached_while_the_films_still_shrink) {
  EXPECT_FALSE(after(0, 2, 0.002).reached(0.01));
  EXPECT_TRUE(after(0, 2, 0.0005).reached(0.01));
}

// The pressures swing by a tenth, which the mean over a period does not see.
TEST(Equilibrium, is_not_reached_while_the_virial_identity_does_not_hold) {
  EXPECT_NEAR(after(0, 2, 0, 1.015).virial_error, 0.015, 0.003);
  EXPECT_FALSE(after(0, 2, 0, 1.025).reached(0.01));
  EXPECT_TRUE(after(0, 2, 0, 1.015).reached(0.01));
}

// One bubble: p − p_0 = 2 · 2σ/R.
TEST(Equilibrium, the_virial_ratio_of_a_bubble_is_one) {
  const double radius = 1e-3;
  state::Phases phases;
  phases.target_volume = {0, 4 * std::numbers::pi / 3 * std::pow(radius, 3), 0};
  mesh::FilmMesh films;
  films.position.resize(3);
  films.triangle.push_back({{0, 1, 2}, 0, 1});
  const std::vector<double> pressure{0, 4 * sigma / radius, 0};
  EXPECT_NEAR(virial_ratio(films, phases, pressure, 4 * std::numbers::pi * radius * radius, sigma), 1, 1e-12);
  films.triangle[0] = {{0, 1, 2}, 1, 2};
  EXPECT_EQ(virial_ratio(films, phases, pressure, 1, sigma), 1);
}

TEST(Equilibrium, window_scales_with_the_mean_bubble) {
  state::Phases phases;
  phases.target_volume = {0, 1e-9, 1e-9};
  state::Materials materials;
  const double once = equilibrium_window(phases, materials);
  for (double& v : phases.target_volume) v *= 4;
  EXPECT_NEAR(equilibrium_window(phases, materials) / once, 2, 1e-12);
}

}  // namespace
}  // namespace spume::simulation
