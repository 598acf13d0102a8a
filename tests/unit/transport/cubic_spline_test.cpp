#include "spume/transport/cubic_spline.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace spume {
namespace {

using namespace transport;

/// 0 = s_0 < … < s_n = length, widths between 0.6 and 1.4 of the mean, varying smoothly (so that finer knots
/// refine).
std::vector<double> uneven_knots(int n, double length) {
  std::vector<double> s;
  for (int k = 0; k <= n; ++k) {
    const double x = static_cast<double>(k) / n;
    s.push_back(length * (x + 0.2 / std::numbers::pi * std::pow(std::sin(std::numbers::pi * x), 2)));
  }
  return s;
}

template <class Function>
double largest_error(const std::vector<double>& s, const std::vector<double>& slope, Function exact) {
  double largest = 0;
  for (std::size_t k = 0; k + 1 < s.size(); ++k)
    for (double t : {0.25, 0.5, 0.75}) {
      const double width = s[k + 1] - s[k];
      const double value = hermite(t, width, exact(s[k]), exact(s[k + 1]), slope[k], slope[k + 1]);
      largest = std::max(largest, std::abs(value - exact(s[k] + t * width)));
    }
  return largest;
}

template <class Function>
std::vector<double> values(const std::vector<double>& s, Function exact) {
  std::vector<double> f;
  for (double x : s) f.push_back(exact(x));
  return f;
}

TEST(CubicSpline, IsExactForCubicsUpToTheEnds) {
  const auto cubic = [](double x) { return 1 + x * (2 + x * (-3 + 0.5 * x)); };
  for (int n : {3, 4, 12}) {
    const std::vector<double> s = uneven_knots(n, 2.0);
    EXPECT_LT(largest_error(s, spline_slopes(s, values(s, cubic)), cubic), 1e-13);
  }
}

TEST(CubicSpline, OnAnOpenLineConvergesToFourthOrder) {
  const auto wave = [](double x) { return std::sin(5 * x); };
  double error[2];
  for (int level : {0, 1}) {
    const std::vector<double> s = uneven_knots(level == 0 ? 80 : 160, 2.0);
    error[level] = largest_error(s, spline_slopes(s, values(s, wave)), wave);
  }
  EXPECT_GT(std::log2(error[0] / error[1]), 3.5);
  EXPECT_LT(std::log2(error[0] / error[1]), 4.5);
}

TEST(CubicSpline, OnARingConvergesToFourthOrderAndClosesSmoothly) {
  const auto wave = [](double x) { return std::sin(2 * std::numbers::pi * (x + 0.3)); };
  double error[2];
  for (int level : {0, 1}) {
    const std::vector<double> s = uneven_knots(level == 0 ? 20 : 40, 1.0);
    const std::vector<double> slope = periodic_spline_slopes(s, values(s, wave));
    error[level] = largest_error(s, slope, wave);
    EXPECT_EQ(slope.front(), slope.back());
    EXPECT_NEAR(slope.front(), 2 * std::numbers::pi * std::cos(0.6 * std::numbers::pi), 0.02);
  }
  EXPECT_GT(std::log2(error[0] / error[1]), 3.5);
  EXPECT_LT(std::log2(error[0] / error[1]), 4.5);
}

}  // namespace
}  // namespace spume
