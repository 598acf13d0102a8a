#include "spume/mesh/locate.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "spume/base/random.hpp"
#include "tests/support/film_shapes.hpp"

namespace spume::mesh {
namespace {

constexpr double radius = 3e-4;  // [m]
constexpr double infinity = std::numeric_limits<double>::infinity();

SurfacePoint closest_of_all(const FilmMesh& mesh, const Vec3& x, const std::function<bool(int)>& accept) {
  SurfacePoint found;
  double best = infinity;
  for (int t = 0; t < mesh.n_triangles(); ++t) {
    if (!accept(t)) continue;
    const auto& v = mesh.triangle[t].vertex;
    std::array<double, 3> weight;
    const double d2 =
        closest_point_on_triangle(x, mesh.position[v[0]], mesh.position[v[1]], mesh.position[v[2]], weight);
    if (d2 < best) {
      best = d2;
      found = {t, weight, std::sqrt(d2)};
    }
  }
  return found;
}

Vec3 random_point(Random& random, double half_width) {
  return {random.uniform(-half_width, half_width), random.uniform(-half_width, half_width),
          random.uniform(-half_width, half_width)};
}

TEST(Locate, the_closest_point_on_a_triangle_is_where_geometry_says) {
  const Vec3 a{0, 0, 0}, b{4, 0, 0}, c{0, 3, 0};
  std::array<double, 3> w;
  EXPECT_DOUBLE_EQ(closest_point_on_triangle({1, 1, 2}, a, b, c, w), 4);  // above the inside
  EXPECT_NEAR(w[1], 0.25, 1e-15);
  EXPECT_NEAR(w[2], 1.0 / 3, 1e-15);
  EXPECT_DOUBLE_EQ(closest_point_on_triangle({-3, -4, 0}, a, b, c, w), 25);  // off a corner
  EXPECT_DOUBLE_EQ(w[0], 1);
  EXPECT_DOUBLE_EQ(closest_point_on_triangle({2, -1, 0}, a, b, c, w), 1);  // off an edge
  EXPECT_DOUBLE_EQ(w[1], 0.5);
  EXPECT_DOUBLE_EQ(w[2], 0);
  EXPECT_NEAR(closest_point_on_triangle({2 + 3, 1.5 + 4, 0}, a, b, c, w), 25, 1e-13);  // off the hypotenuse
  EXPECT_DOUBLE_EQ(closest_point_on_triangle({5, 1, 0}, a, b, b, w), 2);  // a needle is its longest edge
}

TEST(Locate, closest_agrees_with_brute_force_near_and_far) {
  const FilmMesh mesh = shapes::double_bubble(radius, 7);
  const TriangleLocator locator(mesh, 0.15 * radius);
  const auto all = [](int) { return true; };
  const auto septum = [&](int t) { return mesh.triangle[t].phase_a == 1 && mesh.triangle[t].phase_b == 2; };
  Random random(1);
  for (int n = 0; n < 300; ++n) {
    const Vec3 x = random_point(random, (n % 3 == 0 ? 10 : 2) * radius);
    for (const auto& accept : {std::function<bool(int)>(all), std::function<bool(int)>(septum)}) {
      const SurfacePoint expected = closest_of_all(mesh, x, accept);
      const SurfacePoint found = locator.closest(x, infinity, accept);
      EXPECT_EQ(found.triangle, expected.triangle);
      EXPECT_EQ(found.weight, expected.weight);
      EXPECT_EQ(found.distance, expected.distance);
    }
  }
}

TEST(Locate, at_a_vertex_the_first_of_its_triangles_wins) {
  const FilmMesh mesh = shapes::double_bubble(radius, 5);
  const TriangleLocator locator(mesh, 0.1 * radius);
  for (int v = 0; v < mesh.n_vertices(); ++v) {
    const SurfacePoint expected = closest_of_all(mesh, mesh.position[v], [](int) { return true; });
    const SurfacePoint found = locator.closest(mesh.position[v], 0.01 * radius, {});
    EXPECT_EQ(found.triangle, expected.triangle);
    EXPECT_EQ(found.distance, expected.distance);
    EXPECT_LT(found.distance, 1e-12 * radius);
  }
}

TEST(Locate, finds_nothing_beyond_its_reach) {
  const FilmMesh mesh = shapes::sphere({}, radius, 3, 1);
  const TriangleLocator locator(mesh, 0.2 * radius);
  EXPECT_EQ(locator.closest({2 * radius, 0, 0}, 0.99 * radius, {}).triangle, -1);
  EXPECT_GE(locator.closest({2 * radius, 0, 0}, 1.02 * radius, {}).triangle, 0);
  EXPECT_EQ(locator.closest({0, 0, 0}, 0.9 * radius, {}).triangle, -1);
  EXPECT_EQ(locator.closest({0, 0, 0}, infinity, [](int) { return false; }).triangle, -1);
  EXPECT_EQ(TriangleLocator(FilmMesh{}, radius).closest({}, infinity, {}).triangle, -1);
}

TEST(Locate, near_misses_no_triangle_within_the_radius_and_tells_each_once) {
  const FilmMesh mesh = shapes::double_bubble(radius, 7);
  const TriangleLocator locator(mesh, 0.15 * radius);
  Random random(2);
  for (int n = 0; n < 100; ++n) {
    const Vec3 x = random_point(random, 2 * radius);
    const double ball = random.uniform(0, 0.7) * radius;
    const std::vector<int> near = locator.near(x, ball);
    EXPECT_TRUE(std::is_sorted(near.begin(), near.end()));
    EXPECT_EQ(std::adjacent_find(near.begin(), near.end()), near.end());
    for (int t = 0; t < mesh.n_triangles(); ++t) {
      const auto& v = mesh.triangle[t].vertex;
      std::array<double, 3> w;
      const double d2 =
          closest_point_on_triangle(x, mesh.position[v[0]], mesh.position[v[1]], mesh.position[v[2]], w);
      const bool is_listed = std::binary_search(near.begin(), near.end(), t);
      EXPECT_TRUE(is_listed || d2 > ball * ball);
      // A listed triangle meets a bin (0.15 radius wide) that meets the cube around the ball, so its box
      // does.
      EXPECT_TRUE(!is_listed || std::sqrt(d2) < std::sqrt(3.0) * (ball + (0.15 + 0.2) * radius));
    }
  }
}

TEST(Locate, bins_much_too_small_are_enlarged) {
  const FilmMesh mesh = shapes::sphere({}, radius, 1, 1);
  const TriangleLocator locator(mesh, 1e-6 * radius);
  EXPECT_GE(locator.closest({0.9 * radius, 0, 0}, radius, {}).triangle, 0);
}

}  // namespace
}  // namespace spume::mesh
