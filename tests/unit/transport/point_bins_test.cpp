#include "spume/transport/point_bins.hpp"

#include <gtest/gtest.h>

#include "spume/base/random.hpp"
#include "spume/transport/donors.hpp"

namespace spume {
namespace {

std::vector<Vec3> scattered(int n, double size) {
  Random random(11);
  std::vector<Vec3> points;
  for (int p = 0; p < n; ++p)
    points.push_back(
        {random.uniform(-size, size), random.uniform(-size, size), 0.3 * random.uniform(-size, size)});
  return points;
}

TEST(PointBins, FindExactlyThePointsOfABallInOrder) {
  const double size = 1e-3;
  const std::vector<Vec3> points = scattered(500, size);
  for (double bin_size : {0.1 * size, size, 1e-6 * size}) {
    const transport::PointBins bins(points, bin_size);
    for (const Vec3& x : {Vec3{}, points[7], Vec3{2 * size, 0, 0}, Vec3{50 * size, 0, 0}}) {
      const double radius = 0.9 * size;
      std::vector<int> expected;
      for (int p = 0; p < 500; ++p)
        if (norm(points[p] - x) < radius) expected.push_back(p);
      std::vector<transport::Neighbour> found;
      bins.within(x, radius, found);
      ASSERT_EQ(found.size(), expected.size());
      for (std::size_t n = 0; n < found.size(); ++n) EXPECT_EQ(found[n].point, expected[n]);
    }
  }
}

TEST(PointBins, WithoutPointsFindNothing) {
  std::vector<transport::Neighbour> found(3);
  transport::PointBins({}, 1e-4).within({}, 1.0, found);
  EXPECT_TRUE(found.empty());
}

TEST(Donors, AreSearchedFartherAwayUntilThereAreSome) {
  const transport::PointBins bins({{0, 0, 0}, {4e-4, 0, 0}, {5e-4, 0, 0}}, 1e-4);
  const std::vector<Vec3> piece{{0, 0, 0}, {1e-4, 0, 0}};
  const auto not_own = [](int dof) { return dof != 0; };
  using transport::Falloff;
  EXPECT_TRUE(transport::find_donors(bins, piece, 1.5e-4, 2, Falloff::Square, not_own).empty());
  const auto donors = transport::find_donors(bins, piece, 1.5e-4, 3, Falloff::Square, not_own);
  ASSERT_EQ(donors.dof, std::vector<int>{1});
  // 3e-4 from the piece, 1.5·1.5²e-4 = 3.375e-4 the radius.
  const double z = 1 - std::pow(3 / 3.375, 2);
  EXPECT_NEAR(donors.weight[0], z * z, 1e-12);
}

}  // namespace
}  // namespace spume
