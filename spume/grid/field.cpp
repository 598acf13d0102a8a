#include "spume/grid/field.hpp"

#include <mpi.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>

#include "spume/base/contract.hpp"
#include "spume/grid/implementation.hpp"

namespace spume::grid {

namespace {

constexpr int max_ghost_width = 4;  // the thinnest slab

/// The shape of a buffer with ghosts, and the distance between neighbours along each axis.
struct GhostedShape {
  GhostedShape(const Grid& grid, int width_)
      : width(width_),
        inner{grid.cells().i, grid.cells().j, grid.z_end() - grid.z_begin()},
        outer{inner.i + 2 * width_, inner.j + 2 * width_, inner.k + 2 * width_},
        stride{1, outer.i, static_cast<std::ptrdiff_t>(outer.i) * outer.j} {}

  std::size_t size() const { return static_cast<std::size_t>(stride[2]) * outer.k; }

  int width;
  Index3 inner, outer;
  std::array<std::ptrdiff_t, 3> stride;
};

/// Sets the plane `to` across `axis` (counted in the buffer, ghosts included) to `sign` times the plane
/// `from`.
void copy_plane(const GhostedShape& shape, int axis, int to, int from, double sign, double* buffer) {
  double* target = buffer + to * shape.stride[axis];
  const double* source = buffer + from * shape.stride[axis];
  // Planes across z are contiguous, planes across y are rows of each layer, planes across x are columns.
  const std::ptrdiff_t run = axis == 0 ? 1 : axis == 1 ? shape.stride[1] : shape.stride[2];
  const std::ptrdiff_t step = axis == 0 ? shape.stride[1] : shape.stride[2];
  const int repeats = axis == 0 ? shape.outer.j * shape.outer.k : axis == 1 ? shape.outer.k : 1;
  for (int r = 0; r < repeats; ++r, target += step, source += step)
    for (std::ptrdiff_t m = 0; m < run; ++m) target[m] = sign * source[m];
}

enum class Side { Lower, Upper };

/// Mirror images beyond a wall, over the whole extent of the other axes, their ghosts included: filling the
/// axes one after another therefore fills edges and corners too.
void mirror(const GhostedShape& shape, int axis, Side side, Parity parity, double* buffer) {
  const int w = shape.width, n = shape.inner[axis];  // inner planes are w … w+n−1
  const double sign = parity == Parity::Odd ? -1.0 : 1.0;
  for (int g = 0; g < w; ++g) {
    if (side == Side::Lower)
      copy_plane(shape, axis, w - 1 - g, w + g, sign, buffer);
    else
      copy_plane(shape, axis, w + n + g, w + n - 1 - g, sign, buffer);
  }
}

/// Images of the other end, over the whole extent of the other axes.
void wrap(const GhostedShape& shape, int axis, double* buffer) {
  const int w = shape.width, n = shape.inner[axis];
  for (int g = 0; g < w; ++g) {
    copy_plane(shape, axis, g, n + g, 1, buffer);
    copy_plane(shape, axis, w + n + g, w + g, 1, buffer);
  }
}

/// Puts contiguous rows of owned cells to their places in a buffer with ghosts, from layer `k` of the buffer
/// on. `from` may be the beginning of that layer: rows are moved last first.
void place_layers(const GhostedShape& shape, int k, int n_layers, const double* from, double* buffer) {
  const Index3 n = shape.inner;
  for (int layer = n_layers - 1; layer >= 0; --layer)
    for (int j = n.j - 1; j >= 0; --j) {
      double* to = buffer + (k + layer) * shape.stride[2] + (j + shape.width) * shape.stride[1] + shape.width;
      std::memmove(to, from + (static_cast<std::ptrdiff_t>(layer) * n.j + j) * n.i, sizeof(double) * n.i);
    }
}

/// Ghosts across z from the neighbouring ranks; a slab is at least as thick as its ghosts.
void exchange_layers(const Field& f, const GhostedShape& shape, double* buffer) {
  const Grid& grid = f.grid();
  const parallel::Communicator& ranks = grid.communicator();
  const bool periodic = grid.box().boundary[2] == Boundary::Periodic;
  const int w = shape.width, n = shape.inner.k;
  const int above = ranks.rank() + 1 < ranks.size() ? ranks.rank() + 1 : periodic ? 0 : MPI_PROC_NULL;
  const int below = ranks.rank() > 0 ? ranks.rank() - 1 : periodic ? ranks.size() - 1 : MPI_PROC_NULL;
  const std::ptrdiff_t layer = static_cast<std::ptrdiff_t>(shape.inner.i) * shape.inner.j;
  const double* owned = f.values().data();
  const int count = static_cast<int>(w * layer);
  // Layers arrive packed at the beginning of where they belong.
  double *lower = buffer, *upper = buffer + (w + n) * shape.stride[2];
  MPI_Sendrecv(owned + (n - w) * layer, count, MPI_DOUBLE, above, 0, lower, count, MPI_DOUBLE, below, 0,
               ranks.handle(), MPI_STATUS_IGNORE);
  MPI_Sendrecv(owned, count, MPI_DOUBLE, below, 1, upper, count, MPI_DOUBLE, above, 1, ranks.handle(),
               MPI_STATUS_IGNORE);
  if (below != MPI_PROC_NULL) place_layers(shape, 0, w, lower, buffer);
  if (above != MPI_PROC_NULL) place_layers(shape, w + n, w, upper, buffer);
}

}  // namespace

Symmetry velocity_symmetry(const Box& box, int component) {
  Symmetry symmetry = even_symmetry;
  for (int axis = 0; axis < 3; ++axis) {
    const Boundary boundary = box.boundary[axis];
    if (boundary == Boundary::Wall || (boundary == Boundary::Slip && axis == component))
      symmetry[axis] = Parity::Odd;
  }
  return symmetry;
}

VectorField::VectorField(const Grid& grid)
    : components{Field(grid, velocity_symmetry(grid.box(), 0)), Field(grid, velocity_symmetry(grid.box(), 1)),
                 Field(grid, velocity_symmetry(grid.box(), 2))} {}

void exchange_ghosts(const Field& f, int width, std::vector<double>& buffer) {
  expects(width >= 1 && width <= max_ghost_width, "1 to 4 layers of ghosts");
  const Grid& grid = f.grid();
  const GhostedShape shape(grid, width);
  buffer.resize(shape.size());
  place_layers(shape, width, shape.inner.k, f.values().data(), buffer.data());
  const bool periodic_z = grid.box().boundary[2] == Boundary::Periodic;
  if (grid.communicator().size() > 1)
    exchange_layers(f, shape, buffer.data());
  else if (periodic_z)
    wrap(shape, 2, buffer.data());
  if (!periodic_z && grid.z_begin() == 0) mirror(shape, 2, Side::Lower, f.symmetry()[2], buffer.data());
  if (!periodic_z && grid.z_end() == grid.cells().k)
    mirror(shape, 2, Side::Upper, f.symmetry()[2], buffer.data());
  for (int axis : {1, 0}) {
    if (grid.box().boundary[axis] == Boundary::Periodic) {
      wrap(shape, axis, buffer.data());
    } else {
      mirror(shape, axis, Side::Lower, f.symmetry()[axis], buffer.data());
      mirror(shape, axis, Side::Upper, f.symmetry()[axis], buffer.data());
    }
  }
}

std::vector<double> gather(const Field& f) {
  const Grid& grid = f.grid();
  const parallel::Communicator& communicator = grid.communicator();
  expects(grid.total_size() <= static_cast<std::size_t>(std::numeric_limits<int>::max()),
          "a gathered field has at most 2^31 - 1 cells");
  const int layer = grid.cells().i * grid.cells().j;
  std::vector<int> counts(communicator.size()), offsets(communicator.size());
  const int count = static_cast<int>(grid.owned_size());
  const int offset = layer * grid.z_begin();
  MPI_Allgather(&count, 1, MPI_INT, counts.data(), 1, MPI_INT, communicator.handle());
  MPI_Allgather(&offset, 1, MPI_INT, offsets.data(), 1, MPI_INT, communicator.handle());
  std::vector<double> whole(grid.total_size());
  MPI_Allgatherv(f.values().data(), count, MPI_DOUBLE, whole.data(), counts.data(), offsets.data(),
                 MPI_DOUBLE, communicator.handle());
  return whole;
}

void scatter(std::span<const double> whole, Field& f) {
  const Grid& grid = f.grid();
  expects(whole.size() == grid.total_size(), "scatter takes all cells of the box");
  const std::size_t layer = static_cast<std::size_t>(grid.cells().i) * grid.cells().j;
  std::copy_n(whole.begin() + static_cast<std::ptrdiff_t>(layer * grid.z_begin()), grid.owned_size(),
              f.values().begin());
}

namespace {

/// Σ of term(value) over all cells: one number a layer, added in the order of the layers, so that it is the
/// same to the last bit on any number of ranks.
template <class Term>
double sum_by_layers(const Field& f, Term&& term) {
  const Grid& grid = f.grid();
  const Index3 n = grid.cells();
  std::vector<double> of_layer(n.k, 0.0);
  const double* row = f.values().data();
  for (int k = grid.z_begin(); k < grid.z_end(); ++k)
    for (int j = 0; j < n.j; ++j, row += n.i) {
      double of_row = 0;
      for (int i = 0; i < n.i; ++i) of_row += term(row[i]);
      of_layer[k] += of_row;
    }
  grid.communicator().sum(of_layer);
  double total = 0;
  for (const double value : of_layer) total += value;
  return total;
}

}  // namespace

double sum(const Field& f) {
  return sum_by_layers(f, [](double value) { return value; });
}

double sum_of_squares(const Field& f) {
  return sum_by_layers(f, [](double value) { return value * value; });
}

double max_abs(const Field& f) {
  double largest = 0;
  for (const double value : f.values()) {
    const double size = std::abs(value);
    if (!(size <= largest)) largest = std::isnan(size) ? std::numeric_limits<double>::infinity() : size;
  }
  return f.grid().communicator().max(largest);
}

}  // namespace spume::grid
