#include "spume/optics/shading.hpp"

#include <algorithm>
#include <cmath>

namespace spume::optics {

namespace {

double smooth_step(double from, double to, double x) {
  const double t = std::clamp((x - from) / (to - from), 0.0, 1.0);
  return t * t * (3 - 2 * t);
}

/// Light that a mirror at the surface throws to the eye: two soft windows, above left and below right of the
/// camera.
double window_light(const Vec3& normal, const Vec3& direction, const Camera& camera) {
  const Vec3 mirrored = direction - 2 * dot(direction, normal) * normal;
  const Vec3 main = normalized(0.9 * camera.backward() + 0.75 * camera.up() - 0.65 * camera.right());
  const Vec3 second = normalized(0.6 * camera.backward() - 0.8 * camera.up() + 0.7 * camera.right());
  return smooth_step(0.955, 0.985, dot(mirrored, main)) +
         0.25 * smooth_step(0.95, 0.99, dot(mirrored, second));
}

}  // namespace

Surface clear_film(const Colour& tint, const Vec3& normal, const Vec3& direction, const Camera& camera,
                   double strength) {
  const double slant = 1 - std::abs(dot(normal, direction));
  // Reflection grows towards grazing like Schlick's (1 − cos θ)^5, spread inwards so that rims are wide
  // enough to see.
  const double rim = std::pow(slant, 3);
  const double cover = strength * (0.10 + 0.75 * rim);
  const Colour body = mix(tint, 0.55 * tint, rim);
  const double window = 0.55 * strength * window_light(normal, direction, camera);
  return {cover * body + window * Colour{1, 1, 1}, cover + (1 - cover) * window};
}

Surface painted_film(const Colour& paint, const Vec3& normal, const Vec3& direction, double cover) {
  const double facing = std::abs(dot(normal, direction));
  const double full = std::min(1.0, cover + (1 - cover) * std::pow(1 - facing, 2));
  return {full * (0.55 + 0.45 * facing) * paint, full};
}

Surface border_tube(const Vec3& normal, const Vec3& direction, const Camera& camera) {
  const Colour dark = from_screen(38, 50, 66);
  const double facing = std::abs(dot(normal, direction));
  const double shine = 0.15 * window_light(normal, direction, camera);
  return {(0.55 + 0.45 * facing) * dark + shine * Colour{1, 1, 1}, 1};
}

Colour background(double height) {
  return mix(from_screen(252, 253, 255), from_screen(222, 229, 238), smooth_step(0.1, 1.0, height));
}

}  // namespace spume::optics
