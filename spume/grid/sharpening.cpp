#include "spume/grid/sharpening.hpp"

#include <algorithm>

namespace spume::grid {

namespace {

/// Sets what a layer of cells holds on a wall: its lower faces across an axis, of the first cells. Rows are
/// `stride` apart.
void clear_wall(const Index3& n, int axis, int k, std::ptrdiff_t stride, double* layer) {
  if (axis == 2 && k != 0) return;
  const int i_end = axis == 0 ? 1 : n.i, j_end = axis == 1 ? 1 : n.j;
  for (int j = 0; j < j_end; ++j) std::fill_n(layer + j * stride, i_end, 0.0);
}

void clear_wall(Field& f, int axis) {
  const Grid& grid = f.grid();
  const Index3 n = grid.cells();
  double* layer = f.values().data();
  for (int k = grid.z_begin(); k < grid.z_end(); ++k, layer += static_cast<std::ptrdiff_t>(n.i) * n.j)
    clear_wall(n, axis, k, n.i, layer);
}

/// to ← keep·from + factor·λ of, for n cells in a row; `below` and `above` are the rows of `of` in the
/// neighbouring layers, its own neighbours are `stride` apart.
void add_laplacian(int n, const double* from, double keep, const double* of, std::ptrdiff_t stride,
                   const double* below, const double* above, double factor, double* to) {
#pragma GCC ivdep
  for (int i = 0; i < n; ++i) {
    const double neighbours = of[i - 1] + of[i + 1] + of[i - stride] + of[i + stride] + below[i] + above[i];
    to[i] = keep * from[i] + factor * (6 * of[i] - neighbours);
  }
}

}  // namespace

/// Layer k of the image, from three layers of u.
void Sharpening::make_image(int k, int wall_axis) {
  for (int j = 0; j < n_.j; ++j) {
    const double* u = u_.row(j, k);
    add_laplacian(n_.i, u, a, u, u_.stride_y(), u_.row(j, k - 1), u_.row(j, k + 1), b, image_.row(j, k));
  }
  if (wall_axis >= 0) clear_wall(n_, wall_axis, k, image_.stride_y(), image_.row(0, k));
  image_.fill_ghosts(k);
}

/// Layer k of u + λ image, from three layers of the image, into the field.
void Sharpening::finish(int k, int wall_axis, double* layer) {
  for (int j = 0; j < n_.j; ++j) {
    const double* image = image_.row(j, k);
    add_laplacian(n_.i, u_.row(j, k), 1, image, image_.stride_y(), image_.row(j, k - 1), image_.row(j, k + 1),
                  1, layer + static_cast<std::ptrdiff_t>(j) * n_.i);
  }
  if (wall_axis >= 0) clear_wall(n_, wall_axis, k, n_.i, layer);
}

void Sharpening::apply(Field& u, int face_axis) {
  const Grid& grid = u.grid();
  const bool walled = face_axis >= 0 && grid.box().boundary[face_axis] != Boundary::Periodic;
  const int wall_axis = walled ? face_axis : -1;
  if (walled) clear_wall(u, wall_axis);
  u_.open(u, face_axis);
  const auto& [x, y, z] = u_.continuation();
  image_.continue_by(x, y);
  const auto layer = [&](int k) {
    return u.values().data() + static_cast<std::ptrdiff_t>(k - grid.z_begin()) * n_.i * n_.j;
  };
  for (int k = u_.first(); k <= u_.last(); ++k) {
    u_.move_to(k);
    make_image(k, wall_axis);
    if (k == grid.z_begin() && u_.walls().below) image_.take_image(k - 1, z.sign, k);
    if (k > grid.z_begin()) finish(k - 1, wall_axis, layer(k - 1));
  }
  if (!u_.walls().above) return;
  const int top = grid.z_end() - 1;
  image_.take_image(top + 1, z.sign_above(0), top);
  finish(top, wall_axis, layer(top));
}

void Sharpening::apply(VectorField& u, Placement placement) {
  for (int c = 0; c < 3; ++c) apply(u[c], placement == Placement::Faces ? c : -1);
}

}  // namespace spume::grid
