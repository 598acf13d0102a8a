#pragma once

#include <array>
#include <memory>
#include <span>
#include <vector>

#include "spume/base/vec3.hpp"
#include "spume/state/film_frame.hpp"

namespace spume::optics {

/// Where a ray meets the foam.
struct Hit {
  double distance;               ///< along the ray [unit of the points]
  int triangle;                  ///< −1: a Plateau border
  std::array<double, 3> weight;  ///< barycentric, of the triangle
  Vec3 normal;                   ///< of the border's surface, unit, outward; of no meaning on a film
};

/// Finds what rays meet: films, which they go through, and Plateau borders, which stop them (Embree, Wald et
/// al. 2014). Works with lengths of order one internally, so the points may have any scale. Safe to use from
/// several threads.
class Tracer {
 public:
  /// `border_radius` per border point: of the round tubes that are drawn [unit of the points]. Keeps no
  /// reference.
  Tracer(const state::FilmFrame& frame, std::span<const double> border_radius);
  ~Tracer();
  Tracer(const Tracer&) = delete;
  Tracer& operator=(const Tracer&) = delete;

  /// The first `hits.size()` surfaces along the ray from `origin`, nearest first; gives their number.
  int trace(const Vec3& origin, const Vec3& direction, std::span<Hit> hits) const;

 private:
  struct Implementation;
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace spume::optics
