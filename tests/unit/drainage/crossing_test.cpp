#include "spume/drainage/crossing.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace spume::drainage {
namespace {

TEST(CrossingTime, is_exact_for_a_power_law_of_the_stage_time) {
  // η/θ = (t/3)^{−0.8} crosses 1 at t = 3 s; the step runs from 2 to 5 s.
  const auto log_excess = [](double t) { return -0.8 * std::log(t / 3); };
  EXPECT_NEAR(crossing_time(2, {0, log_excess(2)}, {3, log_excess(5)}), 1, 1e-14);
}

TEST(CrossingTime, is_linear_in_time_in_the_first_step) {
  EXPECT_NEAR(crossing_time(0, {0, 1.0}, {4, -3.0}), 1, 1e-15);
}

TEST(CrossingTime, lies_inside_the_bracket_of_a_second_try) {
  const double time = crossing_time(1, {0.5, 0.1}, {0.7, -0.2});
  EXPECT_GT(time, 0.5);
  EXPECT_LT(time, 0.7);
}

}  // namespace
}  // namespace spume::drainage
