#include "spume/grid/kernel_coupling.hpp"

#include <array>
#include <cmath>
#include <numbers>
#include <sstream>

#include "spume/base/contract.hpp"
#include "spume/base/error.hpp"

namespace spume::grid {

namespace {

constexpr int max_cells = 11;  // along one direction, for ζ = 4h and one cell more on either side

/// The kernel of one point along one direction: cells, weights h δ, which sum to one, and minus their second
/// differences, which sum to zero.
struct Stencil {
  int n_cells = 0;
  bool in_one_run = true;                ///< the cells follow each other and none is mirrored
  std::array<int, max_cells> cell;       ///< wrapped or mirrored into the box
  std::array<double, max_cells> weight;  ///< w
  std::array<double, max_cells> bend;    ///< 2 w_m − w_{m−1} − w_{m+1}
  std::array<double, max_cells> mirror;  ///< −1 in mirrored cells, otherwise 1

  /// Sign of a field's value in the m-th cell.
  double sign(Parity parity, int m) const { return parity == Parity::Odd ? mirror[m] : 1.0; }
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
  // Cell i has its centre at i + ½; the kernel reaches those with |i + ½ − position| < ζ, its second
  // difference one more on either side.
  const int first = static_cast<int>(std::floor(position - zeta - 0.5));
  const int last = static_cast<int>(std::ceil(position + zeta - 0.5));
  Stencil stencil;
  stencil.n_cells = last - first + 1;
  for (int m = 0; m < stencil.n_cells; ++m) {
    const double distance = first + m + 0.5 - position;
    const bool inside = m > 0 && m + 1 < stencil.n_cells;
    stencil.weight[m] = inside ? (1 + std::cos(std::numbers::pi * distance / zeta)) / (2 * zeta) : 0;
    bool mirrored = false;
    stencil.cell[m] = fold(first + m, n, boundary, mirrored);
    stencil.mirror[m] = mirrored ? -1 : 1;
    if (mirrored || (m > 0 && stencil.cell[m] != stencil.cell[m - 1] + 1)) stencil.in_one_run = false;
  }
  for (int m = 0; m < stencil.n_cells; ++m) {
    const double below = m > 0 ? stencil.weight[m - 1] : 0;
    const double above = m + 1 < stencil.n_cells ? stencil.weight[m + 1] : 0;
    stencil.bend[m] = 2 * stencil.weight[m] - below - above;
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
  Kernels(const Grid& grid, const KernelCoupling& coupling)
      : grid_(&grid), zeta_(coupling.half_width_cells), sharpening_(coupling.sharpening) {
    expects(zeta_ >= 1 && zeta_ <= 4, "the kernel reaches 1 to 4 cells");
  }

  /// Calls body(m, b, row) for every row of cells of the kernel of `point` that this rank owns: m
  /// counts layers, b rows in the layer, `row` is the place of the row's first cell (0, j, k) in a field, and
  /// weights() then holds the kernel along x: h³ (δ − a h² Δδ).
  template <class Body>
  void for_owned_rows(const Vec3& point, Body&& body) {
    const Vec3 position = (point - grid_->box().lower) / grid_->h();
    // Also false for NaN. Farther points would not fit an int.
    if (!(std::abs(position.x) < 1e9 && std::abs(position.y) < 1e9 && std::abs(position.z) < 1e9))
      throw_lost(point);
    along_[2] = stencil(position, 2);
    const Stencil &x = along_[0], &y = along_[1], &z = along_[2];
    bool others_made = false;
    for (int m = 0; m < z.n_cells; ++m) {
      const int k = z.cell[m];
      if (k < grid_->z_begin() || k >= grid_->z_end()) continue;
      if (!others_made) {
        along_[0] = stencil(position, 0);
        along_[1] = stencil(position, 1);
        others_made = true;
      }
      for (int b = 0; b < y.n_cells; ++b) {
        const double in_plane = y.weight[b] * z.weight[m];
        const double whole = in_plane + sharpening_ * (y.weight[b] * z.bend[m] + y.bend[b] * z.weight[m]);
        for (int a = 0; a < x.n_cells; ++a)
          weights_[a] = whole * x.weight[a] + sharpening_ * in_plane * x.bend[a];
        const std::size_t layer = static_cast<std::size_t>(k - grid_->z_begin());
        body(m, b, (layer * grid_->cells().j + y.cell[b]) * grid_->cells().i);
      }
    }
  }

  const Stencil& along(int axis) const { return along_[axis]; }
  const std::array<double, max_cells>& weights() const { return weights_; }

 private:
  Stencil stencil(const Vec3& position, int axis) const {
    return make_stencil(position[axis], zeta_, grid_->cells()[axis], grid_->box().boundary[axis]);
  }

  const Grid* grid_;
  double zeta_, sharpening_;
  std::array<Stencil, 3> along_;
  std::array<double, max_cells> weights_;
};

}  // namespace

void KernelCoupling::spread(std::span<const Vec3> points, std::span<const Vec3> forces,
                            VectorField& density) const {
  expects(points.size() == forces.size(), "one force per point");
  const Grid& grid = density[0].grid();
  const double per_volume = 1 / (grid.h() * grid.h() * grid.h());
  Kernels kernels(grid, *this);
  const Stencil &x = kernels.along(0), &y = kernels.along(1), &z = kernels.along(2);
  const auto& weight = kernels.weights();
  for (std::size_t p = 0; p < points.size(); ++p)
    kernels.for_owned_rows(points[p], [&](int m, int b, std::size_t row) {
      for (int c = 0; c < 3; ++c) {
        const Symmetry& symmetry = density[c].symmetry();
        double* values = density[c].values().data() + row;
        const double of_row = per_volume * forces[p][c] * z.sign(symmetry[2], m) * y.sign(symmetry[1], b);
        if (x.in_one_run) {
          double* run = values + x.cell[0];
          for (int a = 0; a < x.n_cells; ++a) run[a] += of_row * weight[a];
        } else {
          for (int a = 0; a < x.n_cells; ++a)
            values[x.cell[a]] += of_row * weight[a] * x.sign(symmetry[0], a);
        }
      }
    });
}

void KernelCoupling::sample(const VectorField& u, std::span<const Vec3> points,
                            std::vector<Vec3>& velocities) const {
  const Grid& grid = u[0].grid();
  Kernels kernels(grid, *this);
  const Stencil &x = kernels.along(0), &y = kernels.along(1), &z = kernels.along(2);
  const auto& weight = kernels.weights();
  // One number per point, layer and component: a layer has one owner, so the sum over ranks is exact, and
  // layers are then added in one order, whatever the number of ranks.
  const int max_layers = static_cast<int>(2 * half_width_cells) + 3;
  std::vector<double> of_layer(points.size() * max_layers * 3, 0.0);
  for (std::size_t p = 0; p < points.size(); ++p)
    kernels.for_owned_rows(points[p], [&](int m, int b, std::size_t row) {
      for (int c = 0; c < 3; ++c) {
        const Symmetry& symmetry = u[c].symmetry();
        const double* values = u[c].values().data() + row;
        double of_row = 0;
        if (x.in_one_run) {
          const double* run = values + x.cell[0];
          for (int a = 0; a < x.n_cells; ++a) of_row += weight[a] * run[a];
        } else {
          for (int a = 0; a < x.n_cells; ++a)
            of_row += weight[a] * x.sign(symmetry[0], a) * values[x.cell[a]];
        }
        of_layer[(p * max_layers + m) * 3 + c] += z.sign(symmetry[2], m) * y.sign(symmetry[1], b) * of_row;
      }
    });
  grid.communicator().sum(of_layer);
  velocities.assign(points.size(), Vec3{});
  for (std::size_t p = 0; p < points.size(); ++p)
    for (int m = 0; m < max_layers; ++m)
      for (int c = 0; c < 3; ++c) velocities[p][c] += of_layer[(p * max_layers + m) * 3 + c];
}

}  // namespace spume::grid
