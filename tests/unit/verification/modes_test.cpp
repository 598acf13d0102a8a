#include "spume/verification/modes.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

#include "spume/base/error.hpp"
#include "tests/support/film_shapes.hpp"

namespace spume::verification {
namespace {

mesh::FilmMesh bulged(int n, double amplitude, const Vec3& centre) {
  auto films = shapes::sphere({0, 0, 0}, 1, 4, 1);
  for (auto& x : films.position) x = centre + (1 + amplitude * std::legendre(n, x.z)) * x;
  return films;
}

TEST(ModeAmplitude, is_that_of_the_mode_and_of_no_other) {
  // The mesh is inscribed and the rule over triangles is of second order in edges of 0.07.
  for (const int n : {2, 3, 4}) {
    const auto films = bulged(n, 0.05, {0.3, -0.2, 0.1});
    EXPECT_NEAR(mode_amplitude(films, 1, n), 0.05, 0.05 * 0.015) << n;
    for (const int other : {2, 3, 4}) {
      if (other == n) continue;
      EXPECT_NEAR(mode_amplitude(films, 1, other), 0, 0.05 * 0.05) << n << " " << other;
    }
  }
}

TEST(Centroid, moves_with_the_bubble) {
  const auto films = bulged(2, 0.05, {0.3, -0.2, 0.1});
  const Vec3 c = centroid(films, 1);
  EXPECT_NEAR(norm(c - Vec3{0.3, -0.2, 0.1}), 0, 1e-6);
}

TEST(FitDampedCosine, finds_frequency_and_damping_beside_an_offset) {
  std::vector<double> time, value;
  for (int i = 0; i < 200; ++i) {
    const double t = 0.4 + 0.03 * i;
    time.push_back(t);
    value.push_back(0.02 * std::exp(-0.35 * t) * std::cos(1.9 * t + 0.3) + 0.001);
  }
  const Decay fit = fit_damped_cosine(time, value, {2.0, 0.4});
  EXPECT_NEAR(fit.omega, 1.9, 1e-5);
  EXPECT_NEAR(fit.gamma, 0.35, 1e-5);
}

}  // namespace
}  // namespace spume::verification
