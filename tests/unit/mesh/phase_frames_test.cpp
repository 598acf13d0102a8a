#include "spume/mesh/phase_frames.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "spume/mesh/measure.hpp"
#include "tests/support/film_shapes.hpp"

namespace spume::mesh {
namespace {

constexpr double h = 1e-4;

Domain cube(double edge) {
  return {{-0.5 * edge, -0.5 * edge, -0.5 * edge}, {edge, edge, edge}, {true, true, true}};
}

TEST(PhaseFrames, MeasureASphereThatLiesOverTheCornerOfTheBox) {
  FilmMesh sphere = shapes::sphere({}, 4 * h, 3, 1);
  const double volume = phase_volumes(sphere, 2)[1], area = film_area(sphere);
  sphere.domain = cube(20 * h);
  for (Vec3& x : sphere.position) x = sphere.domain.inside(x + Vec3{10 * h, -9.7 * h, 10.2 * h});
  const PhaseFrames frames(sphere, 2);
  for (int d = 0; d < 3; ++d) {
    EXPECT_TRUE(frames.bounded(1, d));
    EXPECT_NEAR(frames.upper(1)[d] - frames.lower(1)[d], 8 * h, 0.1 * h);
  }
  // Round-off of positions in the box: 1e-16 × 20 h / 4 h.
  EXPECT_NEAR(phase_volumes(sphere, 2)[1] / volume, 1, 1e-14);
  EXPECT_NEAR(film_area(sphere) / area, 1, 1e-14);
}

TEST(PhaseFrames, MeasureALayerBetweenWalls) {
  // A flat film z = 1.5 h from 16 × 16 squares, periodic in x and y; phase 1 above, phase 0 below.
  constexpr int n = 16;
  FilmMesh film;
  film.domain = {{0, 0, -4 * h}, {n * h, n * h, 8 * h}, {true, true, false}};
  for (int j = 0; j < n; ++j)
    for (int i = 0; i < n; ++i) film.position.push_back({i * h, j * h, 1.5 * h});
  const auto vertex = [](int i, int j) { return (j % n) * n + i % n; };
  for (int j = 0; j < n; ++j)
    for (int i = 0; i < n; ++i) {
      film.triangle.push_back(make_triangle(vertex(i, j), vertex(i + 1, j), vertex(i + 1, j + 1), 0, 1));
      film.triangle.push_back(make_triangle(vertex(i, j), vertex(i + 1, j + 1), vertex(i, j + 1), 0, 1));
    }
  const PhaseFrames frames(film, 2);
  EXPECT_FALSE(frames.bounded(1, 0));
  EXPECT_FALSE(frames.bounded(1, 1));
  EXPECT_TRUE(frames.bounded(1, 2));
  EXPECT_NEAR(film_area(film), n * n * h * h, 1e-13 * n * n * h * h);
  EXPECT_NEAR(phase_volumes(film, 2)[1] / (n * n * 2.5 * h * h * h), 1, 1e-12);
}

}  // namespace
}  // namespace spume::mesh
