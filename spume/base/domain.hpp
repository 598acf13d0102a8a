#pragma once

#include <array>
#include <cmath>

#include "spume/base/vec3.hpp"

namespace spume {

/// The box that things lie in, and the directions in which it continues periodically. Points may be stored by
/// any of their images; the default has no periodic direction, and no box.
struct Domain {
  Vec3 lower, size;  ///< [m]
  std::array<bool, 3> periodic{false, false, false};

  bool is_periodic() const { return periodic[0] || periodic[1] || periodic[2]; }
  double volume() const { return size.x * size.y * size.z; }

  /// The image of x nearest to `reference` in each direction; x itself, to the last bit, where that is x.
  Vec3 near(const Vec3& x, const Vec3& reference) const {
    Vec3 image = x;
    for (int d = 0; d < 3; ++d) {
      const double apart = x[d] - reference[d];
      // Nearly always false, which spares the division.
      if (periodic[d] && std::abs(apart) > 0.5 * size[d])
        image[d] -= size[d] * std::nearbyint(apart / size[d]);
    }
    return image;
  }
  /// The shortest step from one point to an image of another [m].
  Vec3 step(const Vec3& from, const Vec3& to) const { return near(to, from) - from; }
  /// The image of x in the box.
  Vec3 inside(const Vec3& x) const {
    Vec3 image = x;
    for (int d = 0; d < 3; ++d)
      if (periodic[d]) image[d] -= size[d] * std::floor((x[d] - lower[d]) / size[d]);
    return image;
  }
  /// Calls body(y) for the images y of x in the box and within `margin` [m] of it along every periodic
  /// direction; with a margin beyond the size, for those in the 26 boxes around.
  template <class Body>
  void for_each_image(const Vec3& x, double margin, Body&& body) const {
    const Vec3 base = inside(x);
    std::array<int, 3> first{0, 0, 0}, last{0, 0, 0};
    for (int d = 0; d < 3; ++d)
      if (periodic[d]) {
        if (base[d] + margin >= lower[d] + size[d]) first[d] = -1;
        if (base[d] - margin <= lower[d]) last[d] = 1;
      }
    for (int k = first[2]; k <= last[2]; ++k)
      for (int j = first[1]; j <= last[1]; ++j)
        for (int i = first[0]; i <= last[0]; ++i) body(base + Vec3{i * size.x, j * size.y, k * size.z});
  }
};

}  // namespace spume
