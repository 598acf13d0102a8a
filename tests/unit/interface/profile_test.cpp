#include "spume/interface/profile.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace spume::interface {
namespace {

constexpr double variance = 2e-8;  // 2 h² for h = 0.1 mm [m²]

/// ∫_0^x of the kernel integrated over the plane, straight from its transform: (1/π) ∫ T(s k²/2) sin(kx)/k
/// dk.
double profile_by_quadrature(double x) {
  const double last = 14 / std::sqrt(variance);
  constexpr int n = 20000;
  double sum = 0;
  for (int m = 0; m < n; ++m) {
    const double k = (m + 0.5) * last / n;
    sum += smoothing_kernel(0.5 * variance * k * k) * std::sin(k * x) / k;
  }
  return sum * last / n / std::numbers::pi;
}

TEST(Profile, IsTheIntegralOfTheKernelAcrossAFlatFilm) {
  for (double cells : {-3.0, -1.2, 0.1, 0.7, 1.0, 2.0, 4.0}) {
    const double x = cells * 1e-4;
    // 20000 midpoints of a smooth integrand that has fallen to e^−98: round-off.
    EXPECT_NEAR(flat_film_profile(x, variance), profile_by_quadrature(x), 1e-10) << cells;
  }
}

TEST(Profile, MapInvertsTheProfileWhereItIsSteep) {
  const FlatFilmMap map(variance, 0.3);
  for (double cells : {-1.0, -0.4, 0.0, 0.01, 0.5, 0.9, 1.1})
    // The chord of the table is within 1e-5 of a width; one Newton step squares that.
    EXPECT_NEAR(map.distance(0.5 + flat_film_profile(cells * 1e-4, variance)), cells * 1e-4, 1e-9 * 1e-4)
        << cells;
}

TEST(Profile, MapIsContinuousAndMonotonicForAllIndicators) {
  const FlatFilmMap map(variance, 0.3);
  double previous = map.distance(-0.5);
  const double step = 1e-4;
  for (double c = -0.5 + step; c < 1.5; c += step) {
    const double x = map.distance(c);
    EXPECT_GT(x, previous);
    // The map's slope is at most that of the continuation, 1/(0.3 × 15/8 × 0.282/σ) with σ = √2 × 1e-4 m.
    EXPECT_LT(x - previous,
              1.01 * step * std::sqrt(variance) / (0.3 * 15 / 8 / std::sqrt(2 * std::numbers::pi)));
    previous = x;
  }
  EXPECT_NEAR(map.distance(0.2), -map.distance(0.8), 1e-15 * 1e-4);
}

}  // namespace
}  // namespace spume::interface
