#include "spume/viim/closest_points.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <map>

#include "spume/mesh/locate.hpp"
#include "straight_films.hpp"
#include "tests/support/film_shapes.hpp"

namespace spume::viim {
namespace {

using testing::h;

// Against a search through all triangles, around convex and concave films, borders and junctions. Where two
// films are nearly equally far, 0.034 h at most, the farther one may be taken.
TEST(ClosestPoints, AreThoseOfASearchThroughAllTrianglesExceptBetweenTwoFilms) {
  const auto box = testing::cube_box(14 * h, 28);
  const double reach = 5 * h;
  const mesh::FilmMesh films = shapes::four_bubbles(6 * h, 8);
  const mesh::TriangleLocator locator(films, 2 * h);
  std::map<std::size_t, ClosestPoint> found;
  for (const auto& p : closest_points(films, box, reach)) found[p.cell] = p;
  double worst = 0;
  int n_other = 0;
  for (std::size_t cell = 0; cell < 28 * 28 * 28; ++cell) {
    const Vec3 x = testing::centre_of_cell(box, cell);
    const auto exact = locator.closest(x, std::numeric_limits<double>::infinity(), {});
    ASSERT_EQ(exact.distance <= reach, found.contains(cell));
    if (exact.distance > reach) continue;
    const auto& p = found[cell];
    EXPECT_NEAR(norm(p.centre - x), 0, 1e-12 * h);
    EXPECT_NEAR(norm(p.centre - p.point), p.distance, 1e-9 * h);
    const double error = p.distance - exact.distance;
    worst = std::max(worst, error);
    n_other += error > 1e-6 * h;
  }
  EXPECT_LT(worst, 0.05 * h);
  EXPECT_LT(n_other, 0.01 * found.size());
}

}  // namespace
}  // namespace spume::viim
