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

/// Where the values of a field lie along one direction: at i + ½ in units of cells, or at i.
enum class Line { Centres, Faces };

/// Index in 0 … n−1 of the value whose image is value `i` of the continued grid; n for the face of the far
/// wall, which no field holds.
int fold(int i, int n, Boundary boundary, Line line, bool& mirrored) {
  mirrored = false;
  if (i >= 0 && i < n) return i;
  const int period = boundary == Boundary::Periodic ? n : 2 * n;
  int image = i % period;
  if (image < 0) image += period;
  if (boundary == Boundary::Periodic || image < n || (image == n && line == Line::Faces)) return image;
  mirrored = true;
  return period - image - (line == Line::Centres ? 1 : 0);
}

/// `position`: distance of the point from the lower face in cells; `zeta`: ζ/h.
Stencil make_stencil(double position, double zeta, int n, Boundary boundary, Line line) {
  // Value i lies at i + offset; the kernel reaches those with |i + offset − position| < ζ, its second
  // difference one more on either side.
  const double offset = line == Line::Centres ? 0.5 : 0;
  const int first = static_cast<int>(std::floor(position - zeta - offset));
  const int last = static_cast<int>(std::ceil(position + zeta - offset));
  Stencil stencil;
  stencil.n_cells = last - first + 1;
  for (int m = 0; m < stencil.n_cells; ++m) {
    const double distance = first + m + offset - position;
    const bool inside = m > 0 && m + 1 < stencil.n_cells;
    stencil.weight[m] = inside ? (1 + std::cos(std::numbers::pi * distance / zeta)) / (2 * zeta) : 0;
    bool mirrored = false;
    stencil.cell[m] = fold(first + m, n, boundary, line, mirrored);
    stencil.mirror[m] = mirrored ? -1 : 1;
    if (mirrored || (m > 0 && stencil.cell[m] != stencil.cell[m - 1] + 1)) stencil.in_one_run = false;
  }
  for (int m = 0; m < stencil.n_cells; ++m) {
    const double below = m > 0 ? stencil.weight[m - 1] : 0;
    const double above = m + 1 < stencil.n_cells ? stencil.weight[m + 1] : 0;
    stencil.bend[m] = 2 * stencil.weight[m] - below - above;
  }
  for (int m = 0; m < stencil.n_cells; ++m)
    if (stencil.cell[m] == n) {  // at the wall nothing is felt and nothing moves
      stencil.cell[m] = 0;
      stencil.weight[m] = stencil.bend[m] = 0;
      stencil.in_one_run = false;
    }
  return stencil;
}

[[noreturn]] void throw_lost(const Vec3& point) {
  std::ostringstream message;
  message << "a point of the film mesh is not finite or has left the box for good: (" << point.x << ", "
          << point.y << ", " << point.z << ") m";
  throw NumericalError(message.str());
}

/// The kernel of a point for one component of a vector field, and the part of it that a rank owns.
class Kernel {
 public:
  Kernel(const Grid& grid, const KernelCoupling& coupling) : grid_(&grid), coupling_(coupling) {
    expects(coupling.half_width_cells >= 1 && coupling.half_width_cells <= 4,
            "the kernel reaches 1 to 4 cells");
  }

  /// Calls body(m, b, row) for every row of values of the kernel of `point` that this rank owns: m counts
  /// layers, b rows in the layer, `row` is the place of the row's first value (0, j, k) in a field, and
  /// weights() then holds the kernel along x: h³ (δ − a h² Δδ).
  template <class Body>
  void for_owned_rows(const Vec3& point, int component, Body&& body) {
    const Vec3 position = (point - grid_->box().lower) / grid_->h();
    // Also false for NaN. Farther points would not fit an int.
    if (!(std::abs(position.x) < 1e9 && std::abs(position.y) < 1e9 && std::abs(position.z) < 1e9))
      throw_lost(point);
    along_[2] = stencil(position, component, 2);
    const Stencil &x = along_[0], &y = along_[1], &z = along_[2];
    const double a = coupling_.sharpening;
    bool others_made = false;
    for (int m = 0; m < z.n_cells; ++m) {
      const int k = z.cell[m];
      if (k < grid_->z_begin() || k >= grid_->z_end()) continue;
      if (!others_made) {
        along_[0] = stencil(position, component, 0);
        along_[1] = stencil(position, component, 1);
        others_made = true;
      }
      for (int b = 0; b < y.n_cells; ++b) {
        const double in_plane = y.weight[b] * z.weight[m];
        const double whole = in_plane + a * (y.weight[b] * z.bend[m] + y.bend[b] * z.weight[m]);
        for (int c = 0; c < x.n_cells; ++c) weights_[c] = whole * x.weight[c] + a * in_plane * x.bend[c];
        const std::size_t layer = static_cast<std::size_t>(k - grid_->z_begin());
        body(m, b, (layer * grid_->cells().j + y.cell[b]) * grid_->cells().i);
      }
    }
  }

  const Stencil& along(int axis) const { return along_[axis]; }
  const std::array<double, max_cells>& weights() const { return weights_; }

 private:
  Stencil stencil(const Vec3& position, int component, int axis) const {
    const bool on_faces = coupling_.placement == Placement::Faces && axis == component;
    return make_stencil(position[axis], coupling_.half_width_cells, grid_->cells()[axis],
                        grid_->box().boundary[axis], on_faces ? Line::Faces : Line::Centres);
  }

  const Grid* grid_;
  KernelCoupling coupling_;
  std::array<Stencil, 3> along_;
  std::array<double, max_cells> weights_;
};

}  // namespace

void KernelCoupling::spread(std::span<const Vec3> points, std::span<const Vec3> forces,
                            VectorField& density) const {
  expects(points.size() == forces.size(), "one force per point");
  const Grid& grid = density[0].grid();
  const double per_volume = 1 / (grid.h() * grid.h() * grid.h());
  Kernel kernel(grid, *this);
  const Stencil &x = kernel.along(0), &y = kernel.along(1), &z = kernel.along(2);
  const auto& weight = kernel.weights();
  for (int c = 0; c < 3; ++c) {
    const Symmetry& symmetry = density[c].symmetry();
    for (std::size_t p = 0; p < points.size(); ++p)
      kernel.for_owned_rows(points[p], c, [&](int m, int b, std::size_t row) {
        double* values = density[c].values().data() + row;
        const double of_row = per_volume * forces[p][c] * z.sign(symmetry[2], m) * y.sign(symmetry[1], b);
        if (x.in_one_run) {
          double* run = values + x.cell[0];
          for (int a = 0; a < x.n_cells; ++a) run[a] += of_row * weight[a];
        } else {
          for (int a = 0; a < x.n_cells; ++a)
            values[x.cell[a]] += of_row * weight[a] * x.sign(symmetry[0], a);
        }
      });
  }
}

void KernelCoupling::sample(const VectorField& u, std::span<const Vec3> points,
                            std::vector<Vec3>& velocities) const {
  const Grid& grid = u[0].grid();
  Kernel kernel(grid, *this);
  const Stencil &x = kernel.along(0), &y = kernel.along(1), &z = kernel.along(2);
  const auto& weight = kernel.weights();
  // One number per point, layer and component: a layer has one owner, so the sum over ranks is exact, and
  // layers are then added in one order, whatever the number of ranks.
  const int max_layers = static_cast<int>(2 * half_width_cells) + 3;
  std::vector<double> of_layer(points.size() * max_layers * 3, 0.0);
  for (int c = 0; c < 3; ++c) {
    const Symmetry& symmetry = u[c].symmetry();
    for (std::size_t p = 0; p < points.size(); ++p)
      kernel.for_owned_rows(points[p], c, [&](int m, int b, std::size_t row) {
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
      });
  }
  grid.communicator().sum(of_layer);
  velocities.assign(points.size(), Vec3{});
  for (std::size_t p = 0; p < points.size(); ++p)
    for (int m = 0; m < max_layers; ++m)
      for (int c = 0; c < 3; ++c) velocities[p][c] += of_layer[(p * max_layers + m) * 3 + c];
}

}  // namespace spume::grid
