#include "spume/simulation/cluster.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace spume::simulation {
namespace {

const grid::Box box{{-8e-3, -8e-3, -8e-3}, {8e-3, 8e-3, 8e-3}, {48, 48, 48}};

TEST(Cluster, is_the_same_for_the_same_seed_and_another_for_another) {
  const ClusterShape shape{.count = 12, .mean_diameter = 3e-3, .spread = 0.2, .seed = 5, .center = {}};
  const auto a = make_cluster(shape, box), b = make_cluster(shape, box);
  ASSERT_EQ(a.size(), 12u);
  for (std::size_t n = 0; n < a.size(); ++n) EXPECT_EQ(a[n].center, b[n].center);
  ClusterShape other = shape;
  other.seed = 6;
  EXPECT_GT(norm(make_cluster(other, box)[0].center - a[0].center), 0.01 * shape.mean_diameter);
}

TEST(Cluster, sits_around_its_centre_and_every_bubble_touches_another) {
  ClusterShape shape{
      .count = 8, .mean_diameter = 3e-3, .spread = 0.1, .seed = 2, .center = Vec3{1e-3, 0, -1e-3}};
  const auto bubbles = make_cluster(shape, box);
  Vec3 centroid;
  for (const auto& bubble : bubbles) centroid += bubble.center / 8.0;
  EXPECT_LT(norm(centroid - *shape.center), 1e-12);
  for (const auto& a : bubbles)
    EXPECT_TRUE(std::any_of(bubbles.begin(), bubbles.end(), [&](const BubbleShape& b) {
      const double distance = norm(a.center - b.center);
      return distance > 0 && distance < a.semi_axes.x + b.semi_axes.x;
    }));
}

// Six spheres at the corners of an octahedron overlap their neighbours but leave its middle free: with the
// centres at distance a from the middle, neighbours are a√2 apart and reach the middle only for r > a.
TEST(EnclosedPockets, finds_the_gap_inside_an_octahedron_of_spheres) {
  const double a = 3e-3;
  const auto octahedron = [&](double r) {
    std::vector<BubbleShape> bubbles;
    for (int d = 0; d < 3; ++d)
      for (int sign : {-1, 1}) {
        BubbleShape bubble{.center = {}, .semi_axes = {r, r, r}};
        bubble.center[d] = sign * a;
        bubbles.push_back(bubble);
      }
    return bubbles;
  };
  const auto count = [&](double r) {
    const auto pocket = enclosed_pockets(octahedron(r), box);
    return std::count(pocket.begin(), pocket.end(), 1);
  };
  EXPECT_EQ(count(0.6 * a), 0);  // gaps between three spheres (their middle at a√(2/3) = 0.816 a) still open
  EXPECT_GT(count(0.9 * a), 0);
  EXPECT_EQ(count(1.05 * a), 0);
}

TEST(PowerPotential, vanishes_on_the_ellipsoid_and_ties_on_the_power_plane) {
  const BubbleShape ellipsoid{.center = {1, 2, 3}, .semi_axes = {1, 2, 3}};
  EXPECT_NEAR(power_potential(ellipsoid, {2, 2, 3}, 1), 0, 1e-15);
  EXPECT_NEAR(power_potential(ellipsoid, {1, 2, 0}, 1), 0, 1e-15);
  const BubbleShape a{.center = {0, 0, 0}, .semi_axes = {2, 2, 2}},
      b{.center = {3, 0, 0}, .semi_axes = {1, 1, 1}};
  const double x = (9 + 4 - 1) / 6.0;  // (d² + r_a² − r_b²) / 2d
  EXPECT_NEAR(power_potential(a, {x, 0.3, -0.7}, 1.5), power_potential(b, {x, 0.3, -0.7}, 1.5), 1e-14);
}

}  // namespace
}  // namespace spume::simulation
