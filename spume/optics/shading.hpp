#pragma once

#include "spume/optics/camera.hpp"
#include "spume/optics/colour.hpp"

namespace spume::optics {

/// What a surface adds to a ray: its own light, and how much of the light behind it it covers.
struct Surface {
  Colour light;  ///< already times the cover
  double cover;  ///< 0 clear … 1 opaque
};

/// A clear film of the given tint. `normal`: unit, either side; `direction`: of the ray, unit.
/// `strength`: 1 for films towards the outside, less for films between bubbles.
Surface clear_film(const Colour& tint, const Vec3& normal, const Vec3& direction, const Camera& camera,
                   double strength);
/// A nearly opaque film of the given colour, darker where seen at a slant.
Surface painted_film(const Colour& paint, const Vec3& normal, const Vec3& direction, double cover);
/// The solid tube of a Plateau border.
Surface border_tube(const Vec3& normal, const Vec3& direction, const Camera& camera);

/// What is behind everything, at a height in the picture from 0 (top) to 1.
Colour background(double height);

}  // namespace spume::optics
