#include "spume/grid/grid.hpp"

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "spume/base/contract.hpp"
#include "spume/base/error.hpp"
#include "spume/grid/implementation.hpp"

namespace spume::grid {

namespace {

constexpr int min_layers = 4;  // the widest ghosts come from one neighbour

/// The slabs of FFTW-MPI's default distribution: so many layers each, the last ones what remains.
int layers_of_slab(int n, int ranks) {
  return (n + ranks - 1) / ranks;
}

int slab_begin(int n, int ranks, int rank) {
  return std::min(n, rank * layers_of_slab(n, ranks));
}

int thinnest_slab(int n, int ranks) {
  return std::min(slab_begin(n, ranks, 1), n - slab_begin(n, ranks, ranks - 1));
}

void check_slabs(const Index3& cells, int ranks) {
  if (std::min({cells.i, cells.j, cells.k}) < min_layers)
    throw InputError("the grid has " + std::to_string(cells.i) + " x " + std::to_string(cells.j) + " x " +
                     std::to_string(cells.k) + " cells; it needs at least " + std::to_string(min_layers) +
                     " in each direction");
  if (thinnest_slab(cells.k, ranks) >= min_layers) return;
  int possible = ranks - 1;
  while (thinnest_slab(cells.k, possible) < min_layers) --possible;
  throw InputError("too many ranks: " + std::to_string(cells.k) +
                   " layers of cells along z cannot be cut into " + std::to_string(ranks) +
                   " slabs of at least " + std::to_string(min_layers) +
                   " layers; the largest number of ranks below that works is " + std::to_string(possible));
}

void check_box(const Box& box) {
  const double h = box.spacing();
  expects(h > 0, "the box has a positive size");
  const Vec3 size = box.size();
  for (int axis = 0; axis < 3; ++axis)
    expects(std::abs(size[axis] - h * box.cells[axis]) <= 1e-9 * size[axis], "the cells are cubes");
}

}  // namespace

Grid::Grid(const parallel::Communicator& communicator, const Box& box)
    : communicator_(communicator),
      box_(box),
      h_(box.spacing()),
      implementation_(std::make_unique<Implementation>()) {
  const int ranks = communicator.size();
  check_slabs(box.cells, ranks);
  check_box(box);
  z_begin_ = slab_begin(box.cells.k, ranks, communicator.rank());
  z_end_ = slab_begin(box.cells.k, ranks, communicator.rank() + 1);
  const std::size_t layer = static_cast<std::size_t>(box.cells.i) * box.cells.j;
  owned_size_ = layer * (z_end_ - z_begin_);
  total_size_ = layer * box.cells.k;
}

Grid::~Grid() = default;

int Grid::owner_of_layer(int k) const {
  return k / layers_of_slab(box_.cells.k, communicator_.size());
}

Symmetry effective_symmetry(const Box& box, Symmetry symmetry) {
  for (int axis = 0; axis < 3; ++axis)
    if (box.boundary[axis] == Boundary::Periodic) symmetry[axis] = Parity::Even;
  return symmetry;
}

Transform& transform_of(const Grid& grid, const Symmetry& symmetry) {
  auto& transform = grid.implementation().transform_of_symmetry[effective_symmetry(grid.box(), symmetry)];
  if (!transform) transform = std::make_unique<Transform>(grid, effective_symmetry(grid.box(), symmetry));
  return *transform;
}

}  // namespace spume::grid
