#include "spume/optics/camera.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace spume::optics {

Camera::Camera(std::span<const Vec3> points, const Viewpoint& viewpoint, double width_by_height,
               double margin) {
  constexpr double degree = std::numbers::pi / 180;
  const double azimuth = viewpoint.azimuth_degrees * degree, elevation = viewpoint.elevation_degrees * degree;
  right_ = {-std::sin(azimuth), std::cos(azimuth), 0};
  backward_ = {std::cos(azimuth) * std::cos(elevation), std::sin(azimuth) * std::cos(elevation),
               std::sin(elevation)};
  up_ = cross(backward_, right_);
  const double tangent = std::tan(0.5 * viewpoint.field_degrees * degree);
  tan_x_ = tangent * std::max(1.0, width_by_height);
  tan_y_ = tangent * std::max(1.0, 1 / width_by_height);
  if (points.empty()) {
    eye_ = 3 * backward_;
    return;
  }
  // A point at (x, y, z) along right, up, backward is in the picture of an eye at (a, b, d) where
  // |x − a| ≤ s_x (d − z) and |y − b| ≤ s_y (d − z), s the tangents less the margin: four planes, touched by
  // the points with the largest z ± x/s_x and z ± y/s_y.
  const double s_x = tan_x_ * (1 - 2 * margin), s_y = tan_y_ * (1 - 2 * margin);
  constexpr double lowest = -std::numeric_limits<double>::infinity();
  double right = lowest, left = lowest, top = lowest, bottom = lowest;
  for (const Vec3& point : points) {
    const double x = dot(point, right_) / s_x, y = dot(point, up_) / s_y, z = dot(point, backward_);
    right = std::max(right, z + x);
    left = std::max(left, z - x);
    top = std::max(top, z + y);
    bottom = std::max(bottom, z - y);
  }
  const double d = std::max(0.5 * (right + left), 0.5 * (top + bottom));
  eye_ = 0.5 * (right - left) * s_x * right_ + 0.5 * (top - bottom) * s_y * up_ + d * backward_;
}

Vec3 Camera::direction(double x, double y) const {
  return normalized((2 * x - 1) * tan_x_ * right_ + (1 - 2 * y) * tan_y_ * up_ - backward_);
}

void Camera::project(const Vec3& point, double& x, double& y) const {
  const Vec3 from_eye = point - eye_;
  const double depth = -dot(from_eye, backward_);
  x = 0.5 + 0.5 * dot(from_eye, right_) / (depth * tan_x_);
  y = 0.5 - 0.5 * dot(from_eye, up_) / (depth * tan_y_);
}

}  // namespace spume::optics
