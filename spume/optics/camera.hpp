#pragma once

#include <span>

#include "spume/base/vec3.hpp"

namespace spume::optics {

/// From where a picture is seen; z is up.
struct Viewpoint {
  double azimuth_degrees = -62;   ///< of the eye, from x towards y
  double elevation_degrees = 18;  ///< of the eye above the horizon
  double field_degrees = 28;      ///< angle of the shorter side of the picture
};

/// A perspective camera.
class Camera {
 public:
  /// As near as it can be so that all points are in a picture of the given shape (width/height) with a free
  /// margin on each side (a fraction of it). Lengths may have any scale. Without points it looks at the
  /// origin.
  Camera(std::span<const Vec3> points, const Viewpoint& viewpoint, double width_by_height,
         double margin = 0.06);

  const Vec3& eye() const { return eye_; }
  const Vec3& up() const { return up_; }
  const Vec3& right() const { return right_; }
  const Vec3& backward() const { return backward_; }
  /// Unit direction of the ray through a place in the picture: x from 0 (left) to 1, y from 0 (top) to 1;
  /// both may lie outside of the picture.
  Vec3 direction(double x, double y) const;
  /// Place in the picture of a point, in the same numbers.
  void project(const Vec3& point, double& x, double& y) const;
  /// Length that fills the height of the picture at a distance of one from the eye.
  double height_at_unit_distance() const { return 2 * tan_y_; }

 private:
  Vec3 eye_, right_, up_, backward_;
  double tan_x_, tan_y_;  ///< of half the angles of the picture
};

}  // namespace spume::optics
