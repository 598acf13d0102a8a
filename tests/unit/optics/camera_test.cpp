#include "spume/optics/camera.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace spume::optics {
namespace {

const std::vector<Vec3> points{{0, 0, 0}, {3e-3, 0, 1e-3}, {-1e-3, 2e-3, 5e-4}, {1e-3, 1e-3, -2e-3}};

TEST(Camera, FitsThePointsUpToTheMargin) {
  for (const double shape : {0.5, 1.0, 2.0}) {
    const Camera camera(points, {}, shape, 0.1);
    double x_low = 1, x_high = 0, y_low = 1, y_high = 0;
    for (const Vec3& point : points) {
      double x, y;
      camera.project(point, x, y);
      x_low = std::min(x_low, x);
      x_high = std::max(x_high, x);
      y_low = std::min(y_low, y);
      y_high = std::max(y_high, y);
    }
    // Round-off only: one direction is filled to the margin, both are centred there.
    EXPECT_NEAR(std::max(x_high - x_low, y_high - y_low), 0.8, 1e-12);
    EXPECT_GE(std::min(x_low, y_low), 0.1 - 1e-12);
    EXPECT_LE(std::max(x_high, y_high), 0.9 + 1e-12);
  }
}

TEST(Camera, RayThroughTheImageOfAPointMeetsThePoint) {
  const Camera camera(points, {.azimuth_degrees = 20, .elevation_degrees = 35}, 1.5);
  for (const Vec3& point : points) {
    double x, y;
    camera.project(point, x, y);
    const Vec3 away = normalized(point - camera.eye()) - camera.direction(x, y);
    EXPECT_LT(norm(away), 1e-14);
  }
}

TEST(Camera, HigherPointsAreHigherInThePicture) {
  const Camera camera(points, {}, 1);
  double x, y_low, y_high;
  camera.project({0, 0, 0}, x, y_low);
  camera.project({0, 0, 1e-3}, x, y_high);
  EXPECT_LT(y_high, y_low);
  EXPECT_GT(camera.backward().z, 0) << "the eye is above the foam";
}

}  // namespace
}  // namespace spume::optics
