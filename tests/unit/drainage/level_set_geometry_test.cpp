#include "spume/drainage/level_set_geometry.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace spume::drainage {
namespace {

const Vec3 gravity{1, -2, -9};
/// Points on the unit sphere, none on a grid line.
std::vector<Vec3> sphere_points() {
  std::vector<Vec3> points;
  for (int n = 1; n < 40; ++n)
    points.push_back(normalized({std::sin(1.0 * n), std::cos(1.7 * n), std::sin(2.3 * n)}));
  return points;
}

TEST(LevelSetGeometry, of_a_plane_is_exact) {
  const Vec3 normal = normalized({1, 2, -0.5});
  const auto found =
      geometry_of_level_set([&](const Vec3& x) { return 3 * dot(x, normal); }, 0.1, gravity, sphere_points());
  for (double k : found.curvature_squared) EXPECT_NEAR(k, 0, 1e-24);
  for (const Vec3& g : found.tangential_gravity)
    EXPECT_NEAR(norm(g - (gravity - dot(gravity, normal) * normal)), 0, 1e-13);
}

struct Errors {
  double k = 0, g = 0;
};
/// Mean errors over points of the unit sphere, where k = 2 and g_s = g − (g·x) x, with ψ that is not a
/// distance.
Errors sphere_errors(double spacing) {
  const auto points = sphere_points();
  const auto found = geometry_of_level_set([](const Vec3& x) { return std::exp(norm_squared(x)); }, spacing,
                                           gravity, points);
  Errors errors;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Vec3 exact = gravity - dot(gravity, points[i]) * points[i];
    errors.k += std::abs(found.curvature_squared[i] - 2) / static_cast<double>(points.size());
    errors.g += norm(found.tangential_gravity[i] - exact) / static_cast<double>(points.size());
  }
  return errors;
}

TEST(LevelSetGeometry, of_a_sphere_is_second_order_in_the_spacing) {
  const Errors coarse = sphere_errors(0.04), fine = sphere_errors(0.02);
  EXPECT_LT(fine.k, 0.01);
  EXPECT_LT(fine.g, 0.02);
  // Where the points lie in their cells changes with the spacing: what is left of that in the mean.
  EXPECT_NEAR(std::log2(coarse.k / fine.k), 2, 0.2);
  EXPECT_NEAR(std::log2(coarse.g / fine.g), 2, 0.2);
}

}  // namespace
}  // namespace spume::drainage
