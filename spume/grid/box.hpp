#pragma once

#include <array>

#include "spume/base/domain.hpp"
#include "spume/base/index3.hpp"
#include "spume/base/vec3.hpp"

namespace spume::grid {

/// What happens at the two faces of the box across one direction.
enum class Boundary {
  Periodic,
  Wall,  ///< no slip: u = 0
  Slip,  ///< free slip: the normal velocity and the normal derivative of the tangential one vanish
};

/// The simulated box and its cubic cells.
struct Box {
  Vec3 lower;    ///< [m]
  Vec3 upper;    ///< [m]
  Index3 cells;  ///< number along x, y, z
  std::array<Boundary, 3> boundary{Boundary::Periodic, Boundary::Periodic, Boundary::Periodic};

  /// Edge of a cell h [m].
  double spacing() const { return (upper.x - lower.x) / cells.i; }
  Vec3 size() const { return upper - lower; }
  bool is_periodic() const;
  Domain domain() const;  ///< as the films see it
};

}  // namespace spume::grid
