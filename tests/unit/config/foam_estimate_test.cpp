#include "spume/config/foam_estimate.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace spume::config {
namespace {

using simulation::BubbleShape;

constexpr double pi = std::numbers::pi;

grid::Box box_of(double half, int n) {
  return {{-half, -half, -half}, {half, half, half}, {n, n, n}};
}

// Counting is exact on average over directions; a sphere has them all. What is left is the roughness of
// counting cells, about one cell in the circumference of a great circle.
TEST(FoamEstimate, gives_area_and_volume_of_a_sphere) {
  const double r = 1.5e-3;
  const FoamEstimate estimate = estimate_foam({{{1e-5, 0, -2e-5}, {r, r, r}}}, box_of(2e-3, 64));
  EXPECT_NEAR(estimate.film_area / (4 * pi * r * r), 1, 0.02);
  EXPECT_NEAR(estimate.gas_volume / (4 * pi / 3 * r * r * r), 1, 0.01);
  EXPECT_EQ(estimate.border_length, 0);
  EXPECT_TRUE(estimate.pockets.empty());
}

// Two spheres of radius r whose centres are r apart: a disc and its rim of radius r √3/2, and two caps of
// height 3r/2. The centres lie along (1, 2, 3), so that the disc is not along the grid; a single direction is
// wrong by up to 15 %.
TEST(FoamEstimate, gives_films_and_border_of_two_spheres_that_overlap) {
  const double r = 1e-3;
  const Vec3 half = 0.5 * r * normalized(Vec3{1, 2, 3});
  const FoamEstimate estimate = estimate_foam({{half, {r, r, r}}, {-half, {r, r, r}}}, box_of(2e-3, 96));
  const double rim = r * std::sqrt(3.0) / 2;
  EXPECT_NEAR(estimate.film_area / (2 * 2 * pi * r * 1.5 * r + pi * rim * rim), 1, 0.05);
  EXPECT_NEAR(estimate.border_length / (2 * pi * rim), 1, 0.15);
}

TEST(FoamEstimate, gives_the_same_on_a_grid_so_fine_that_it_is_coarsened) {
  const double r = 1.5e-3;
  const std::vector<BubbleShape> bubbles{{{0, 0, 0}, {r, r, r}}};
  const double coarse = estimate_foam(bubbles, box_of(2e-3, 64)).film_area;
  EXPECT_NEAR(estimate_foam(bubbles, box_of(2e-3, 318)).film_area / coarse, 1, 0.02);
}

// Six spheres on the axes at distance 1.3 r around the origin overlap their neighbours (1.3 √2 r < 2 r) on
// all twelve edges of the octahedron but leave the middle free; eight more close its faces.
TEST(FoamEstimate, finds_a_pocket_and_where_it_is) {
  const double r = 1e-3;
  const Vec3 middle{2e-4, 0, 0};
  std::vector<BubbleShape> bubbles;
  for (int axis = 0; axis < 3; ++axis)
    for (const double sign : {-1.0, 1.0}) {
      Vec3 center = middle;
      center[axis] += sign * 1.3 * r;
      bubbles.push_back({center, {r, r, r}});
    }
  for (int corner = 0; corner < 8; ++corner) {
    const Vec3 direction{corner & 1 ? 1.0 : -1.0, corner & 2 ? 1.0 : -1.0, corner & 4 ? 1.0 : -1.0};
    bubbles.push_back({middle + 1.3 * r * normalized(direction), {r, r, r}});
  }
  const FoamEstimate estimate = estimate_foam(bubbles, box_of(3e-3, 96));
  ASSERT_EQ(estimate.pockets.size(), 1u);
  EXPECT_NEAR(norm(estimate.pockets[0].position - middle), 0, 6e-3 / 96) << "within a cell";
  EXPECT_GT(estimate.pockets[0].volume, 4 * pi / 3 * std::pow(0.3 * r, 3))
      << "the ball that no sphere reaches";
  bubbles.pop_back();
  EXPECT_TRUE(estimate_foam(bubbles, box_of(3e-3, 96)).pockets.empty()) << "open where a sphere is missing";
}

}  // namespace
}  // namespace spume::config
