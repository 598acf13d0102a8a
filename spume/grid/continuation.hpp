#pragma once

#include "spume/grid/field.hpp"

namespace spume::grid {

/// How the values of a field go on beyond the faces across an axis: ghosts are images of cells, times a sign.
struct Continuation {
  Boundary boundary = Boundary::Periodic;
  double sign = 1;
  bool on_wall = false;  ///< the values lie on faces, and the first and the one above the last are a wall's

  Continuation() = default;
  /// With `on_faces` the values lie on the lower faces of the cells; those on a wall are zero.
  Continuation(const Field& f, int axis, bool on_faces = false) : boundary(f.grid().box().boundary[axis]) {
    if (boundary == Boundary::Periodic) return;
    sign = f.symmetry()[axis] == Parity::Odd ? -1 : 1;
    on_wall = on_faces;
  }
  /// Places along the axis, ghosts counted, of the cells whose images are the g-th ghosts, counted from the
  /// face, for w layers of ghosts and n inner places. The 0th above is a wall's own face where values lie on
  /// faces: its sign is 0, and its place some cell's.
  int below(int g, int w, int n) const {
    return boundary == Boundary::Periodic ? w + n - 1 - g : w + g + (on_wall ? 1 : 0);
  }
  int above(int g, int w, int n) const {
    return boundary == Boundary::Periodic ? w + g : w + n - 1 - g + (on_wall && g > 0 ? 1 : 0);
  }
  /// The sign of the g-th ghosts above.
  double sign_above(int g) const { return on_wall && g == 0 ? 0 : sign; }
};

/// Receives the first `depth` layers of the rank above into `above` and the last of the rank below into
/// `below`, packed, across a periodic box as well; leaves what lies beyond a wall as it is. Collective.
void exchange_layers(const Field& f, int depth, double* below, double* above);

/// Whether the owned cells of a grid end at a wall below and above.
struct WallsAlongZ {
  explicit WallsAlongZ(const Grid& grid)
      : below(grid.box().boundary[2] != Boundary::Periodic && grid.z_begin() == 0),
        above(grid.box().boundary[2] != Boundary::Periodic && grid.z_end() == grid.cells().k) {}
  bool below, above;
};

}  // namespace spume::grid
