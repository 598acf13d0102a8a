#include "spume/grid/kernel_coupling.hpp"

#include <array>
#include <cmath>
#include <numbers>
#include <sstream>

#include "spume/base/contract.hpp"
#include "spume/base/error.hpp"

namespace spume::grid {

namespace {

constexpr int max_cells = 9;  // along one direction, for ζ = 4h

/// The kernel of one point along one direction: cells and weights h δ, which sum to one.
struct Stencil {
  int n_cells;
  std::array<int, max_cells> cell;     ///< wrapped or mirrored into the box
  std::array<double, max_cells> even;  ///< weights for fields that are even (or periodic) along the direction
  std::array<double, max_cells> odd;   ///< the same with minus in mirrored cells

  const double* weights(Parity parity) const { return parity == Parity::Even ? even.data() : odd.data(); }
};

/// Index in 0 … n−1 of the cell whose image is cell `i` of the continued grid.
int fold(int i, int n, Boundary boundary, bool& mirrored) {
  mirrored = false;
  if (i >= 0 && i < n) return i;
  const int period = boundary == Boundary::Periodic ? n : 2 * n;
  int image = i % period;
  if (image < 0) image += period;
  mirrored = image >= n;
  return mirrored ? period - 1 - image : image;
}

/// `position`: distance of the point from the lower face in cells; `zeta`: ζ/h.
Stencil make_stencil(double position, double zeta, int n, Boundary boundary) {
  // Cell i has its centre at i + ½; the kernel reaches those with |i + ½ − position| < ζ.
  const int first = static_cast<int>(std::floor(position - zeta - 0.5)) + 1;
  const int last = static_cast<int>(std::ceil(position + zeta - 0.5)) - 1;
  Stencil stencil;
  stencil.n_cells = last - first + 1;
  for (int m = 0; m < stencil.n_cells; ++m) {
    const double distance = first + m + 0.5 - position;
    const double weight = (1 + std::cos(std::numbers::pi * distance / zeta)) / (2 * zeta);
    bool mirrored = false;
    stencil.cell[m] = fold(first + m, n, boundary, mirrored);
    stencil.even[m] = weight;
    stencil.odd[m] = mirrored ? -weight : weight;
  }
  return stencil;
}

[[noreturn]] void throw_lost(const Vec3& point) {
  std::ostringstream message;
  message << "a point of the film mesh is not finite or has left the box for good: (" << point.x << ", "
          << point.y << ", " << point.z << ") m";
  throw NumericalError(message.str());
}

/// Kernels of points on a grid, and the part of them that a rank owns.
class Kernels {
 public:
  Kernels(const Grid& grid, double zeta) : grid_(&grid), zeta_(zeta) {
    expects(zeta >= 1 && zeta <= 4, "the kernel reaches 1 to 4 cells");
  }

  /// Calls body(m, layer) for the m-th layer of the kernel of `point` where this rank owns it, counted from
  /// z_begin; along(axis) then holds the kernel of the point.
  template <class Body>
  void for_owned_layers(const Vec3& point, Body&& body) {
    const Vec3 position = (point - grid_->box().lower) / grid_->h();
    // Also false for NaN. Farther points would not fit an int.
    if (!(std::abs(position.x) < 1e9 && std::abs(position.y) < 1e9 && std::abs(position.z) < 1e9))
      throw_lost(point);
    along_[2] = stencil(position, 2);
    bool others_made = false;
    for (int m = 0; m < along_[2].n_cells; ++m) {
      const int k = along_[2].cell[m];
      if (k < grid_->z_begin() || k >= grid_->z_end()) continue;
      if (!others_made) {
        along_[0] = stencil(position, 0);
        along_[1] = stencil(position, 1);
        others_made = true;
      }
      body(m, k - grid_->z_begin());
    }
  }

  const Stencil& along(int axis) const { return along_[axis]; }

 private:
  Stencil stencil(const Vec3& position, int axis) const {
    return make_stencil(position[axis], zeta_, grid_->cells()[axis], grid_->box().boundary[axis]);
  }

  const Grid* grid_;
  double zeta_;
  std::array<Stencil, 3> along_;
};

}  // namespace

void KernelCoupling::spread(std::span<const Vec3> points, std::span<const Vec3> forces,
                            VectorField& density) const {
  expects(points.size() == forces.size(), "one force per point");
  const Grid& grid = density[0].grid();
  const Index3 n = grid.cells();
  const double per_volume = 1 / (grid.h() * grid.h() * grid.h());
  Kernels kernels(grid, half_width_cells);
  const Stencil &x = kernels.along(0), &y = kernels.along(1), &z = kernels.along(2);
  for (std::size_t p = 0; p < points.size(); ++p)
    kernels.for_owned_layers(points[p], [&](int m, int layer) {
      for (int c = 0; c < 3; ++c) {
        const Symmetry& symmetry = density[c].symmetry();
        const double *wx = x.weights(symmetry[0]), *wy = y.weights(symmetry[1]), *wz = z.weights(symmetry[2]);
        double* values = density[c].values().data() + static_cast<std::size_t>(layer) * n.j * n.i;
        const double of_layer = per_volume * forces[p][c] * wz[m];
        for (int b = 0; b < y.n_cells; ++b) {
          double* row = values + static_cast<std::size_t>(y.cell[b]) * n.i;
          const double of_row = of_layer * wy[b];
          for (int a = 0; a < x.n_cells; ++a) row[x.cell[a]] += of_row * wx[a];
        }
      }
    });
}

void KernelCoupling::sample(const VectorField& u, std::span<const Vec3> points,
                            std::vector<Vec3>& velocities) const {
  const Grid& grid = u[0].grid();
  const Index3 n = grid.cells();
  Kernels kernels(grid, half_width_cells);
  const Stencil &x = kernels.along(0), &y = kernels.along(1), &z = kernels.along(2);
  // One number per point, layer and component: a layer has one owner, so the sum over ranks is exact, and
  // layers are then added in one order, whatever the number of ranks.
  const int max_layers = static_cast<int>(2 * half_width_cells) + 1;
  std::vector<double> of_layer(points.size() * max_layers * 3, 0.0);
  for (std::size_t p = 0; p < points.size(); ++p)
    kernels.for_owned_layers(points[p], [&](int m, int layer) {
      for (int c = 0; c < 3; ++c) {
        const Symmetry& symmetry = u[c].symmetry();
        const double *wx = x.weights(symmetry[0]), *wy = y.weights(symmetry[1]), *wz = z.weights(symmetry[2]);
        const double* values = u[c].values().data() + static_cast<std::size_t>(layer) * n.j * n.i;
        double total = 0;
        for (int b = 0; b < y.n_cells; ++b) {
          const double* row = values + static_cast<std::size_t>(y.cell[b]) * n.i;
          double of_row = 0;
          for (int a = 0; a < x.n_cells; ++a) of_row += wx[a] * row[x.cell[a]];
          total += wy[b] * of_row;
        }
        of_layer[(p * max_layers + m) * 3 + c] = wz[m] * total;
      }
    });
  grid.communicator().sum(of_layer);
  velocities.assign(points.size(), Vec3{});
  for (std::size_t p = 0; p < points.size(); ++p)
    for (int m = 0; m < max_layers; ++m)
      for (int c = 0; c < 3; ++c) velocities[p][c] += of_layer[(p * max_layers + m) * 3 + c];
}

}  // namespace spume::grid
