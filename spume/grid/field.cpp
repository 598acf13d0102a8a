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

/// How the values of a field go on beyond one face across an axis: the image of the g-th ghost, counted from
/// the face, and its sign.
struct Continuation {
  Boundary boundary;
  double sign;

  Continuation(const Field& f, int axis)
      : boundary(f.grid().box().boundary[axis]),
        sign(boundary != Boundary::Periodic && f.symmetry()[axis] == Parity::Odd ? -1.0 : 1.0) {}
  /// Places along the axis, ghosts counted, of the images for a width w and n inner places.
  int below(int g, int w, int n) const { return boundary == Boundary::Periodic ? w + n - 1 - g : w + g; }
  int above(int g, int w, int n) const { return boundary == Boundary::Periodic ? w + g : w + n - 1 - g; }
};

void copy(const double* from, std::ptrdiff_t n, double sign, double* to) {
  for (std::ptrdiff_t m = 0; m < n; ++m) to[m] = sign * from[m];
}

/// Fills a layer of a buffer from the rows of owned cells, contiguous in `from`, with its ghosts across x and
/// y while the layer is in cache. `from` may be the beginning of that layer: rows are moved last first.
void fill_layer(const GhostedShape& shape, const Continuation& x, const Continuation& y, const double* from,
                double* layer) {
  const int w = shape.width, nx = shape.inner.i, ny = shape.inner.j;
  const std::ptrdiff_t stride = shape.stride[1];
  for (int j = ny - 1; j >= 0; --j) {
    double* row = layer + (j + w) * stride;
    std::memmove(row + w, from + static_cast<std::ptrdiff_t>(j) * nx, sizeof(double) * nx);
    for (int g = 0; g < w; ++g) {
      row[w - 1 - g] = x.sign * row[x.below(g, w, nx)];
      row[w + nx + g] = x.sign * row[x.above(g, w, nx)];
    }
  }
  for (int g = 0; g < w; ++g) {
    copy(layer + y.below(g, w, ny) * stride, stride, y.sign, layer + (w - 1 - g) * stride);
    copy(layer + y.above(g, w, ny) * stride, stride, y.sign, layer + (w + ny + g) * stride);
  }
}

/// Layers of the neighbouring ranks beyond the ends of the slab, packed, each to the first of the ghost
/// layers where it belongs; false where there is no neighbour. A slab is at least as thick as its ghosts.
std::array<bool, 2> receive_layers(const Field& f, const GhostedShape& shape, double* lower, double* upper) {
  const parallel::Communicator& ranks = f.grid().communicator();
  const bool periodic = f.grid().box().boundary[2] == Boundary::Periodic;
  const int above = ranks.rank() + 1 < ranks.size() ? ranks.rank() + 1 : periodic ? 0 : MPI_PROC_NULL;
  const int below = ranks.rank() > 0 ? ranks.rank() - 1 : periodic ? ranks.size() - 1 : MPI_PROC_NULL;
  const std::ptrdiff_t layer = static_cast<std::ptrdiff_t>(shape.inner.i) * shape.inner.j;
  const double* owned = f.values().data();
  const int count = static_cast<int>(shape.width * layer);
  MPI_Sendrecv(owned + (shape.inner.k - shape.width) * layer, count, MPI_DOUBLE, above, 0, lower, count,
               MPI_DOUBLE, below, 0, ranks.handle(), MPI_STATUS_IGNORE);
  MPI_Sendrecv(owned, count, MPI_DOUBLE, below, 1, upper, count, MPI_DOUBLE, above, 1, ranks.handle(),
               MPI_STATUS_IGNORE);
  return {below != MPI_PROC_NULL, above != MPI_PROC_NULL};
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
  const Continuation x(f, 0), y(f, 1), z(f, 2);
  const int w = width, n = shape.inner.k;
  const std::ptrdiff_t layer = static_cast<std::ptrdiff_t>(shape.inner.i) * shape.inner.j;
  const auto at = [&](int k) { return buffer.data() + k * shape.stride[2]; };
  for (int k = 0; k < n; ++k) fill_layer(shape, x, y, f.values().data() + k * layer, at(w + k));

  const bool alone = grid.communicator().size() == 1;
  const auto [from_below, from_above] =
      alone ? std::array{false, false} : receive_layers(f, shape, at(0), at(w + n));
  for (int g = w - 1; g >= 0; --g) {  // packed layers move to their places last first
    if (from_below)
      fill_layer(shape, x, y, at(0) + g * layer, at(g));
    else
      copy(at(z.below(w - 1 - g, w, n)), shape.stride[2], z.sign, at(g));
    if (from_above)
      fill_layer(shape, x, y, at(w + n) + g * layer, at(w + n + g));
    else
      copy(at(z.above(g, w, n)), shape.stride[2], z.sign, at(w + n + g));
  }
}

std::vector<double> gather(const Field& f) {
  const Grid& grid = f.grid();
  const parallel::Communicator& communicator = grid.communicator();
  expects(grid.total_size() <= static_cast<std::size_t>(std::numeric_limits<int>::max()),
          "a gathered field has at most 2^31 - 1 cells");
  if (communicator.size() == 1) return {f.values().begin(), f.values().end()};
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
