#include "spume/optics/tracer.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "spume/base/random.hpp"
#include "tests/support/film_shapes.hpp"

namespace spume::optics {
namespace {

/// A frame of spheres of radii 1, 2, …, n times `unit` around the origin.
state::FilmFrame nested_spheres(int n, double unit) {
  state::FilmFrame frame;
  for (int s = 1; s <= n; ++s) {
    const auto films = shapes::sphere({0, 0, 0}, s * unit, 4, 1);
    const int first = static_cast<int>(frame.film_point.size());
    frame.film_point.insert(frame.film_point.end(), films.position.begin(), films.position.end());
    for (const auto& t : films.triangle)
      frame.triangle.push_back({{first + t.vertex[0], first + t.vertex[1], first + t.vertex[2]}, s, 0, 1});
  }
  return frame;
}

TEST(Tracer, FindsAllFilmsInTheOrderOfTheRayAtAnyScale) {
  const Vec3 direction = normalized({1, 0.3, 0.2});
  for (const double unit : {1.0, 1e-6}) {
    const auto frame = nested_spheres(3, unit);
    const Tracer tracer(frame, {});
    std::array<Hit, 16> hits;
    const int n = tracer.trace(-10 * unit * direction, direction, hits);
    ASSERT_EQ(n, 6);
    const double expected[] = {7, 8, 9, 11, 12, 13};
    // The triangles of the spheres lie up to 0.2 % of the radius inside them.
    for (int h = 0; h < 6; ++h) EXPECT_NEAR(hits[h].distance, expected[h] * unit, 0.01 * unit);
    const auto& triangle = frame.triangle[hits[0].triangle];
    Vec3 point;
    for (int c = 0; c < 3; ++c) point += hits[0].weight[c] * frame.film_point[triangle.point[c]];
    // Single precision of the ray tracer.
    EXPECT_LT(norm(point - (hits[0].distance - 10 * unit) * direction), 1e-5 * unit);
  }
}

TEST(Tracer, KeepsTheNearestWhenThereAreTooMany) {
  const Tracer tracer(nested_spheres(5, 1), {});
  std::array<Hit, 4> hits;
  ASSERT_EQ(tracer.trace({-10, 0.01, 0.02}, {1, 0, 0}, hits), 4);
  for (int h = 0; h < 4; ++h) EXPECT_NEAR(hits[h].distance, 5 + h, 0.02);
}

TEST(Tracer, ClosedFilmHasNoGapsAndNoDoubleEdges) {
  const auto frame = nested_spheres(1, 1);
  const Tracer tracer(frame, {});
  std::array<Hit, 16> hits;
  Random random(5);
  const auto anywhere = [&] {
    return Vec3{random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1)};
  };
  for (int n = 0; n < 20000; ++n) {
    const Vec3 eye = 3 * normalized(anywhere());
    EXPECT_EQ(tracer.trace(eye, normalized(0.5 * anywhere() - eye), hits), 2);
  }
  // Exactly through a vertex six triangles compete; none may count twice.
  for (const Vec3& vertex : frame.film_point) EXPECT_LE(tracer.trace(3 * vertex, -vertex, hits), 2);
}

TEST(Tracer, BorderEndsTheRay) {
  auto frame = nested_spheres(2, 1);
  frame.border_point = {{0, 0, -3}, {0, 0, 3}};
  frame.border_line = {{0, 1}};
  const std::vector<double> radius{0.1, 0.1};
  const Tracer tracer(frame, radius);
  std::array<Hit, 16> hits;
  ASSERT_EQ(tracer.trace({-10, 0.05, 0.3}, {1, 0, 0}, hits), 3);
  EXPECT_GE(hits[1].triangle, 0);
  EXPECT_EQ(hits[2].triangle, -1);
  EXPECT_NEAR(hits[2].distance, 10 - std::sqrt(0.01 - 0.0025), 1e-5);
  EXPECT_NEAR(hits[2].normal.y, 0.5, 1e-3);
  EXPECT_EQ(tracer.trace({-10, 0.15, 0.3}, {1, 0, 0}, hits), 4);  // beside it
}

TEST(Tracer, NothingIsMetWhereThereIsNothing) {
  std::array<Hit, 16> hits;
  EXPECT_EQ(Tracer({}, {}).trace({0, 0, 0}, {1, 0, 0}, hits), 0);
}

}  // namespace
}  // namespace spume::optics
