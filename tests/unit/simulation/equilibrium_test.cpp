#include "spume/simulation/equilibrium.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace spume::simulation {
namespace {

constexpr double sigma = 0.03, area = 1e-4;

/// Feeds a damped oscillation of relative amplitude `amplitude` for `duration` periods of 1 s, 50 samples a
/// period.
EquilibriumMeasure after(double amplitude, double duration, double shrinking = 0) {
  RearrangeState rearrange;
  EquilibriumMeasure measure;
  for (double t = 0; t <= duration + 1e-9; t += 0.02) {
    rearrange.elapsed = t;
    const double speed = amplitude * std::sin(2 * std::numbers::pi * t);
    measure = measure_equilibrium(rearrange, 1.0, 2 * sigma * area * speed * speed,
                                  area * (1 - shrinking * t), sigma);
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
