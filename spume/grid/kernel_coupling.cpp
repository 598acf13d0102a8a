#include "spume/grid/kernel_coupling.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
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

/// The cosine of a kernel: π/ζ [1/h], and what turns it from one cell to the next.
struct Cosine {
  explicit Cosine(double half_width)
      : zeta(half_width), beta(std::numbers::pi / zeta), cos_step(std::cos(beta)), sin_step(std::sin(beta)) {}

  double zeta;  ///< ζ/h
  double beta, cos_step, sin_step;
};

/// `position`: distance of the point from the lower face in cells.
void make_stencil(double position, const Cosine& cosine, int n, Boundary boundary, Line line,
                  Stencil& stencil) {
  // Value i lies at i + offset; the kernel reaches those with |i + offset − position| < ζ, its second
  // difference one more on either side.
  const double zeta = cosine.zeta, offset = line == Line::Centres ? 0.5 : 0;
  const int first = static_cast<int>(std::floor(position - zeta - offset));
  const int last = static_cast<int>(std::ceil(position + zeta - offset));
  stencil.n_cells = last - first + 1;
  const bool inside_box = first >= 0 && last < n;
  stencil.in_one_run = true;
  // cos(α + mβ) = cos α cos mβ − sin α sin mβ, by rotation from one cell to the next.
  const double alpha = cosine.beta * (first + offset - position), factor = 0.5 / zeta;
  double cos_here = std::cos(alpha), sin_here = std::sin(alpha);
  for (int m = 0; m < stencil.n_cells; ++m) {
    const bool inside = m > 0 && m + 1 < stencil.n_cells;
    stencil.weight[m] = inside ? factor * (1 + cos_here) : 0;
    const double cos_next = cos_here * cosine.cos_step - sin_here * cosine.sin_step;
    sin_here = sin_here * cosine.cos_step + cos_here * cosine.sin_step;
    cos_here = cos_next;
    stencil.cell[m] = first + m;
    stencil.mirror[m] = 1;
    if (inside_box) continue;
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
  if (inside_box) return;
  for (int m = 0; m < stencil.n_cells; ++m)
    if (stencil.cell[m] == n) {  // at the wall nothing is felt and nothing moves
      stencil.cell[m] = 0;
      stencil.weight[m] = stencil.bend[m] = 0;
      stencil.in_one_run = false;
    }
}

[[noreturn]] void throw_lost(const Vec3& point) {
  std::ostringstream message;
  message << "a point of the film mesh is not finite or has left the box for good: (" << point.x << ", "
          << point.y << ", " << point.z << ") m";
  throw NumericalError(message.str());
}

using Eight = double __attribute__((vector_size(64)));  // one instruction's worth, or a few

/// A row of a kernel: whole × weight + straight × bend of the stencil along x.
struct Row {
  std::size_t place;  ///< of its first value (0, j, k) in a field
  double whole, straight;
};

/// The part along x of a component's kernel. Up to eight cells in one run are eight places that lie in the
/// row, those beyond the kernel with weight zero: whole vectors are quicker than a few numbers.
struct RowWeights {
  const Stencil* stencil = nullptr;
  bool odd = false;
  bool as_vector = false;
  int first = 0;
  Eight weight, bend;

  void set(const Stencil& x, Parity parity, int n) {
    stencil = &x;
    odd = parity == Parity::Odd;
    as_vector = x.in_one_run && x.n_cells <= 8 && n >= 8;
    if (!as_vector) return;
    first = std::min(x.cell[0], n - 8);
    const int shift = x.cell[0] - first;
    std::array<double, 8> w{}, b{};
    for (int m = 0; m < x.n_cells; ++m) {
      w[shift + m] = x.weight[m];
      b[shift + m] = x.bend[m];
    }
    std::memcpy(&weight, w.data(), sizeof weight);
    std::memcpy(&bend, b.data(), sizeof bend);
  }
  double sign(int m) const { return odd ? stencil->mirror[m] : 1.0; }
};

/// The kernels of a point for the three components of a vector field, and the part of them that a rank owns.
class Kernel {
 public:
  Kernel(const Grid& grid, const KernelCoupling& coupling)
      : grid_(&grid), coupling_(coupling), cosine_(coupling.half_width_cells) {
    expects(coupling.half_width_cells >= 1 && coupling.half_width_cells <= 4,
            "the kernel reaches 1 to 4 cells");
  }

  /// Takes a point; false where this rank owns nothing of its kernels.
  bool move_to(const Vec3& point) {
    const Vec3 position = (point - grid_->box().lower) / grid_->h();
    // Also false for NaN. Farther points would not fit an int.
    if (!(std::abs(position.x) < 1e9 && std::abs(position.y) < 1e9 && std::abs(position.z) < 1e9))
      throw_lost(point);
    const bool on_faces = coupling_.placement == Placement::Faces;
    set(position, 2, Line::Centres);
    if (on_faces) set(position, 2, Line::Faces);
    if (!owns_some(centres_[2]) && !(on_faces && owns_some(faces_[2]))) return false;
    for (int axis = 0; axis < 2; ++axis) {
      set(position, axis, Line::Centres);
      if (on_faces) set(position, axis, Line::Faces);
    }
    return true;
  }

  /// Calls layer(m, rows) for the layers of a component's kernel that this rank owns: the factors of a row
  /// are those of h³ (δ − a h² Δδ) across x, with the signs of the field's images.
  template <class Layer>
  void for_owned_layers(int component, const Symmetry& symmetry, RowWeights& x, Layer&& layer) const {
    const Stencil &y = along(component, 1), &z = along(component, 2);
    const Index3 n = grid_->cells();
    x.set(along(component, 0), symmetry[0], n.i);
    const double a = coupling_.sharpening;
    std::array<Row, max_cells> rows;
    for (int m = 0; m < z.n_cells; ++m) {
      const int k = z.cell[m];
      if (k < grid_->z_begin() || k >= grid_->z_end()) continue;
      const std::size_t first_row = static_cast<std::size_t>(k - grid_->z_begin()) * n.j;
      for (int b = 0; b < y.n_cells; ++b) {
        const double sign = z.sign(symmetry[2], m) * y.sign(symmetry[1], b);
        const double in_plane = sign * y.weight[b] * z.weight[m];
        rows[b] = {(first_row + y.cell[b]) * n.i,
                   in_plane + sign * a * (y.weight[b] * z.bend[m] + y.bend[b] * z.weight[m]), a * in_plane};
      }
      layer(m, std::span<const Row>(rows.data(), y.n_cells));
    }
  }

 private:
  void set(const Vec3& position, int axis, Line line) {
    Stencil& stencil = line == Line::Faces ? faces_[axis] : centres_[axis];
    make_stencil(position[axis], cosine_, grid_->cells()[axis], grid_->box().boundary[axis], line, stencil);
  }
  bool owns_some(const Stencil& z) const {
    for (int m = 0; m < z.n_cells; ++m)
      if (z.cell[m] >= grid_->z_begin() && z.cell[m] < grid_->z_end()) return true;
    return false;
  }
  const Stencil& along(int component, int axis) const {
    return coupling_.placement == Placement::Faces && axis == component ? faces_[axis] : centres_[axis];
  }

  const Grid* grid_;
  KernelCoupling coupling_;
  Cosine cosine_;
  std::array<Stencil, 3> centres_, faces_;
};

/// Adds force times the rows of a kernel to the values of a field.
void add_rows(std::span<const Row> rows, const RowWeights& x, double force, double* values) {
  for (const Row& row : rows) {
    double* to = values + row.place;
    const double whole = force * row.whole, straight = force * row.straight;
    if (x.as_vector) {
      Eight sum;
      std::memcpy(&sum, to + x.first, sizeof sum);
      sum += whole * x.weight + straight * x.bend;
      std::memcpy(to + x.first, &sum, sizeof sum);
    } else {
      const Stencil& s = *x.stencil;
      for (int m = 0; m < s.n_cells; ++m)
        to[s.cell[m]] += (whole * s.weight[m] + straight * s.bend[m]) * x.sign(m);
    }
  }
}

/// Sum of the values of a field times the rows of a kernel.
double sum_of_rows(std::span<const Row> rows, const RowWeights& x, const double* values) {
  if (x.as_vector) {
    Eight whole{}, straight{};
    for (const Row& row : rows) {
      Eight value;
      std::memcpy(&value, values + row.place + x.first, sizeof value);
      whole += row.whole * value;
      straight += row.straight * value;
    }
    const Eight products = whole * x.weight + straight * x.bend;
    double sum = 0;
    for (int m = 0; m < 8; ++m) sum += products[m];
    return sum;
  }
  const Stencil& s = *x.stencil;
  double sum = 0;
  for (const Row& row : rows)
    for (int m = 0; m < s.n_cells; ++m)
      sum += (row.whole * s.weight[m] + row.straight * s.bend[m]) * x.sign(m) * values[row.place + s.cell[m]];
  return sum;
}

}  // namespace

void KernelCoupling::spread(std::span<const Vec3> points, std::span<const Vec3> forces,
                            VectorField& density) const {
  expects(points.size() == forces.size(), "one force per point");
  const Grid& grid = density[0].grid();
  const double per_volume = 1 / (grid.h() * grid.h() * grid.h());
  Kernel kernel(grid, *this);
  RowWeights x;
  for (std::size_t p = 0; p < points.size(); ++p) {
    if (!kernel.move_to(points[p])) continue;
    for (int c = 0; c < 3; ++c)
      kernel.for_owned_layers(c, density[c].symmetry(), x, [&](int, std::span<const Row> rows) {
        add_rows(rows, x, per_volume * forces[p][c], density[c].values().data());
      });
  }
}

void KernelCoupling::sample(const VectorField& u, std::span<const Vec3> points,
                            std::vector<Vec3>& velocities) const {
  const Grid& grid = u[0].grid();
  Kernel kernel(grid, *this);
  RowWeights x;
  // One number per point, layer and component: a layer has one owner, so the sum over ranks is exact, and
  // layers are then added in one order, whatever the number of ranks.
  const int max_layers = static_cast<int>(2 * half_width_cells) + 3;
  std::vector<double> of_layer(points.size() * max_layers * 3, 0.0);
  for (std::size_t p = 0; p < points.size(); ++p) {
    if (!kernel.move_to(points[p])) continue;
    for (int c = 0; c < 3; ++c)
      kernel.for_owned_layers(c, u[c].symmetry(), x, [&](int m, std::span<const Row> rows) {
        of_layer[(p * max_layers + m) * 3 + c] = sum_of_rows(rows, x, u[c].values().data());
      });
  }
  grid.communicator().sum(of_layer);
  velocities.assign(points.size(), Vec3{});
  for (std::size_t p = 0; p < points.size(); ++p)
    for (int m = 0; m < max_layers; ++m)
      for (int c = 0; c < 3; ++c) velocities[p][c] += of_layer[(p * max_layers + m) * 3 + c];
}

}  // namespace spume::grid
