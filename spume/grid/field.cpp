#include "spume/grid/field.hpp"

#include <mpi.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>

#include "spume/base/contract.hpp"
#include "spume/grid/continuation.hpp"
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

  // What others send is packed at the beginning of its place, and moved within it last layer first.
  exchange_layers(f, w, at(0), at(w + n));
  const WallsAlongZ wall(grid);
  for (int g = w - 1; g >= 0; --g) {
    if (wall.below)
      copy(at(z.below(w - 1 - g, w, n)), shape.stride[2], z.sign, at(g));
    else
      fill_layer(shape, x, y, at(0) + g * layer, at(g));
    if (wall.above)
      copy(at(z.above(g, w, n)), shape.stride[2], z.sign, at(w + n + g));
    else
      fill_layer(shape, x, y, at(w + n) + g * layer, at(w + n + g));
  }
}

void exchange_layers(const Field& f, int depth, double* below, double* above) {
  const Grid& grid = f.grid();
  const parallel::Communicator& ranks = grid.communicator();
  const WallsAlongZ wall(grid);
  const std::ptrdiff_t count = static_cast<std::ptrdiff_t>(depth) * grid.cells().i * grid.cells().j;
  const double* first = f.values().data();
  const double* last = first + (f.values().size() - count);
  if (ranks.size() == 1) {
    if (!wall.below) std::copy_n(last, count, below);
    if (!wall.above) std::copy_n(first, count, above);
    return;
  }
  const int up = wall.above ? MPI_PROC_NULL : (ranks.rank() + 1) % ranks.size();
  const int down = wall.below ? MPI_PROC_NULL : (ranks.rank() + ranks.size() - 1) % ranks.size();
  const int n = static_cast<int>(count);
  MPI_Sendrecv(last, n, MPI_DOUBLE, up, 0, below, n, MPI_DOUBLE, down, 0, ranks.handle(), MPI_STATUS_IGNORE);
  MPI_Sendrecv(first, n, MPI_DOUBLE, down, 1, above, n, MPI_DOUBLE, up, 1, ranks.handle(), MPI_STATUS_IGNORE);
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
