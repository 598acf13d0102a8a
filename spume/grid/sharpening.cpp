#include "spume/grid/sharpening.hpp"

#include <algorithm>

namespace spume::grid {

namespace {

/// Zeros on the lower faces of the first cells across an axis, which are a wall's.
void clear_wall(Field& f, int axis) {
  const Grid& grid = f.grid();
  const Index3 n = grid.cells();
  const auto value = owned(f);
  const int j_end = axis == 1 ? 1 : n.j, i_end = axis == 0 ? 1 : n.i;
  for (int k = grid.z_begin(); k < (axis == 2 ? std::min(1, grid.z_end()) : grid.z_end()); ++k)
    for (int j = 0; j < j_end; ++j)
      for (int i = 0; i < i_end; ++i) value(i, j, k) = 0;
}

}  // namespace

/// to ← keep·to + factor·λ of. Values across `walled_axis` (−1: none) lie on faces, and the one beyond the
/// last is a wall.
void Sharpening::add_laplacian(const Field& of, double keep, double factor, int walled_axis, Field& to) {
  ghosted_.update(of);
  const Grid& grid = of.grid();
  const Index3 n = grid.cells();
  const std::ptrdiff_t sy = ghosted_.stride_y(), sz = ghosted_.stride_z();
  double* row = to.values().data();
  for (int k = grid.z_begin(); k < grid.z_end(); ++k)
    for (int j = 0; j < n.j; ++j, row += n.i) {
      const double* v = ghosted_.at(0, j, k);
#pragma GCC ivdep
      for (int i = 0; i < n.i; ++i) {
        const double neighbours = v[i - 1] + v[i + 1] + v[i - sy] + v[i + sy] + v[i - sz] + v[i + sz];
        row[i] = keep * row[i] + factor * (6 * v[i] - neighbours);
      }
      // The ghosts are mirror images of values at centres; here the far wall's face holds zero.
      if (walled_axis == 0) row[n.i - 1] += factor * v[n.i];
      const bool below_wall = (walled_axis == 1 && j == n.j - 1) || (walled_axis == 2 && k == n.k - 1);
      const double* beyond = v + (walled_axis == 1 ? sy : sz);
      for (int i = 0; below_wall && i < n.i; ++i) row[i] += factor * beyond[i];
    }
}

void Sharpening::apply(VectorField& u, Placement placement) {
  for (int c = 0; c < 3; ++c) {
    const bool walled = placement == Placement::Faces && u[c].grid().box().boundary[c] != Boundary::Periodic;
    const int axis = walled ? c : -1;
    if (walled) clear_wall(u[c], c);
    image_ = u[c];
    add_laplacian(u[c], a, b, axis, image_);
    if (walled) clear_wall(image_, c);
    add_laplacian(image_, 1, 1, axis, u[c]);
    if (walled) clear_wall(u[c], c);
  }
}

}  // namespace spume::grid
