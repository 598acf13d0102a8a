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

/// The slabs of FFTW-MPI's default distribution: ⌈n/ranks⌉ layers each, the last ones what remains.
int slab_begin(int n, int ranks, int rank) {
  const int block = (n + ranks - 1) / ranks;
  return std::min(n, rank * block);
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

DMBoundaryType petsc_boundary(Boundary boundary) {
  return boundary == Boundary::Periodic ? DM_BOUNDARY_PERIODIC : DM_BOUNDARY_GHOSTED;
}

GhostExchange make_exchange(const Grid& grid, int width) {
  using parallel::petsc_check;
  const Index3 n = grid.cells();
  const auto& boundary = grid.box().boundary;
  const MPI_Comm comm = grid.communicator().handle();
  const int ranks = grid.communicator().size();
  std::vector<PetscInt> layers(ranks);
  for (int r = 0; r < ranks; ++r) layers[r] = slab_begin(n.k, ranks, r + 1) - slab_begin(n.k, ranks, r);

  GhostExchange exchange;
  petsc_check(DMDACreate3d(comm, petsc_boundary(boundary[0]), petsc_boundary(boundary[1]),
                           petsc_boundary(boundary[2]), DMDA_STENCIL_BOX, n.i, n.j, n.k, 1, 1, ranks, 1,
                           width, &n.i, &n.j, layers.data(), exchange.dm.out()));
  petsc_check(DMSetUp(exchange.dm.get()));
  const auto owned_size = static_cast<PetscInt>(grid.owned_size());
  const PetscInt ghosted_size =
      (n.i + 2 * width) * (n.j + 2 * width) * (grid.z_end() - grid.z_begin() + 2 * width);
  petsc_check(VecCreateMPIWithArray(comm, 1, owned_size, PETSC_DETERMINE, nullptr, exchange.owned.out()));
  petsc_check(VecCreateSeqWithArray(PETSC_COMM_SELF, 1, ghosted_size, nullptr, exchange.ghosted.out()));
  return exchange;
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

GhostExchange& ghost_exchange(const Grid& grid, int width) {
  auto& cache = grid.implementation().exchange_of_width;
  auto found = cache.find(width);
  if (found == cache.end()) found = cache.emplace(width, make_exchange(grid, width)).first;
  return found->second;
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
