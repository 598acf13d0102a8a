#include "spume/viim/local_cubic.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "straight_films.hpp"

namespace spume::viim {
namespace {

using testing::h;

Vec3 centre(const grid::Box& box, int i, int j, int k) {
  return box.lower + box.spacing() * Vec3{i + 0.5, j + 0.5, k + 0.5};
}

TEST(LocalCubic, IsExactForACubicWithItsDerivatives) {
  const auto box = testing::cube_box(8 * h, 16);
  const auto f = [](const Vec3& x) {  // [m], of lengths in cells
    const double a = x.x / h, b = x.y / h, c = x.z / h;
    return h * (a * a * a - 2 * a * b * c + b * b * c + 3 * c * c - a + 0.5);
  };
  const Vec3 x{0.31 * h, -0.77 * h, 1.2 * h};
  const LocalCubic cubic(box, x, [&](int i, int j, int k) { return f(centre(box, i, j, k)); });
  const auto t = cubic.at(x);
  const double a = 0.31, b = -0.77, c = 1.2;
  EXPECT_NEAR(t.value, f(x), 1e-11 * h);
  EXPECT_NEAR(t.gradient.x, 3 * a * a - 2 * b * c - 1, 1e-11);
  EXPECT_NEAR(t.gradient.y, -2 * a * c + 2 * b * c, 1e-11);
  EXPECT_NEAR(t.gradient.z, -2 * a * b + b * b + 6 * c, 1e-11);
  const double expected[] = {6 * a, 2 * c, 6, -2 * c, -2 * a + 2 * b, -2 * b};
  for (int n = 0; n < 6; ++n) EXPECT_NEAR(t.hessian[n] * h, expected[n], 1e-10) << n;
}

TEST(LocalCubic, FindsTheClosestPointOfAPlane) {
  const auto box = testing::cube_box(8 * h, 16);
  const Vec3 normal = normalized(Vec3{1, -2, 0.5});
  const auto f = [&](const Vec3& x) { return 3 * (dot(x, normal) - 0.2 * h); };  // not a distance
  const Vec3 x = 0.9 * h * normal + Vec3{0.3 * h, 0, 0.1 * h};
  const Vec3 exact = x - (dot(x, normal) - 0.2 * h) * normal;
  const Vec3 start = exact + Vec3{0.2 * h, 0.1 * h, -0.3 * h};
  const LocalCubic cubic(box, start, [&](int i, int j, int k) { return f(centre(box, i, j, k)); });
  const auto found = cubic.closest_zero(x, start);
  ASSERT_TRUE(found);
  EXPECT_LT(norm(*found - exact), 1e-8 * h);
}

TEST(LocalCubic, GivesNothingWhenTheSurfaceIsFarFromTheStart) {
  const auto box = testing::cube_box(8 * h, 16);
  const LocalCubic cubic(box, {}, [&](int i, int j, int k) { return centre(box, i, j, k).x - 2 * h; });
  EXPECT_FALSE(cubic.closest_zero({h, 0, 0}, {}));
}

// Points two cells from a sphere given by its distance, whose tricubic is of fourth order.
TEST(LocalCubic, FindsTheClosestPointOfASphereToFourthOrder) {
  const double radius = 6.3 * h;
  std::vector<double> error;
  for (int cells : {24, 48}) {
    const auto box = testing::cube_box(12 * h, cells);
    double worst = 0;
    for (int n = 0; n < 300; ++n) {
      const double z = -1 + (2 * n + 1) / 300.0, a = 2.4 * n, r = std::sqrt(1 - z * z);
      const Vec3 out{r * std::cos(a), r * std::sin(a), z};
      const LocalCubic cubic(box, radius * out,
                             [&](int i, int j, int k) { return norm(centre(box, i, j, k)) - radius; });
      const Vec3 x = (radius + 2 * box.spacing()) * out,
                 start = radius * out + 0.1 * box.spacing() * Vec3{1, 1, 1};
      const auto found = cubic.closest_zero(x, start);
      ASSERT_TRUE(found);
      worst = std::max(worst, std::abs(norm(x - *found) - 2 * box.spacing()));
    }
    error.push_back(worst);
  }
  const double order = std::log2(error[0] / error[1]);
  EXPECT_GT(order, 3.5);
  EXPECT_LT(order, 5);
}

}  // namespace
}  // namespace spume::viim
