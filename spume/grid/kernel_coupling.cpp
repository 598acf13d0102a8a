#include "spume/grid/kernel_coupling.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <sstream>

#include "spume/base/contract.hpp"
#include "spume/base/error.hpp"

namespace spume::grid {

namespace {

constexpr int reach = 4;  // values under a kernel along one direction

/// The kernel of one point along one direction: values, and weights h δ, which sum to one.
struct Stencil {
  bool in_one_run = true;            ///< the values follow each other and none is mirrored
  std::array<int, reach> cell;       ///< wrapped or mirrored into the box
  std::array<double, reach> weight;  ///< w
  std::array<double, reach> mirror;  ///< −1 in mirrored cells, otherwise 1

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

/// `position`: distance of the point from the lower face in cells.
void make_stencil(double position, int n, Boundary boundary, Line line, Stencil& stencil) {
  const double place = line == Line::Centres ? position - 0.5 : position;  // value i lies at i
  const double below = std::floor(place), t = place - below, u = 1 - t;
  stencil.weight = {u * u * u / 6, 2.0 / 3 - t * t + 0.5 * t * t * t, 2.0 / 3 - u * u + 0.5 * u * u * u,
                    t * t * t / 6};
  const int first = static_cast<int>(below) - 1;
  stencil.in_one_run = true;
  for (int m = 0; m < reach; ++m) stencil.cell[m] = first + m;
  stencil.mirror.fill(1);
  if (first >= 0 && first + reach <= n) return;
  for (int m = 0; m < reach; ++m) {
    bool mirrored = false;
    stencil.cell[m] = fold(first + m, n, boundary, line, mirrored);
    stencil.mirror[m] = mirrored ? -1 : 1;
    if (mirrored || (m > 0 && stencil.cell[m] != stencil.cell[m - 1] + 1)) stencil.in_one_run = false;
  }
  for (int m = 0; m < reach; ++m)
    if (stencil.cell[m] == n) {  // at the wall nothing is felt and nothing moves
      stencil.cell[m] = 0;
      stencil.weight[m] = 0;
      stencil.in_one_run = false;
    }
}

[[noreturn]] void throw_lost(const Vec3& point) {
  std::ostringstream message;
  message << "a point of the film mesh is not finite or has left the box for good: (" << point.x << ", "
          << point.y << ", " << point.z << ") m";
  throw NumericalError(message.str());
}

using Four = double __attribute__((vector_size(32)));  // one instruction's worth, or two

/// A row of a kernel: `factor` × weights of the stencil along x.
struct Row {
  std::size_t place;  ///< of its first value (0, j, k) in a field
  double factor;
};

/// The part along x of a component's kernel.
struct RowWeights {
  const Stencil* stencil = nullptr;
  bool odd = false;
  Four weight;

  void set(const Stencil& x, Parity parity) {
    stencil = &x;
    odd = parity == Parity::Odd;
    std::memcpy(&weight, x.weight.data(), sizeof weight);
  }
  double sign(int m) const { return odd ? stencil->mirror[m] : 1.0; }
};

/// The kernels of a point for the three components of a vector field, and the part of them that a rank owns.
class Kernel {
 public:
  Kernel(const Grid& grid, const KernelCoupling& coupling) : grid_(&grid), placement_(coupling.placement) {}

  /// Takes a point; false where this rank owns nothing of its kernels.
  bool move_to(const Vec3& point) {
    const Vec3 position = (point - grid_->box().lower) / grid_->h();
    // Also false for NaN. Farther points would not fit an int.
    if (!(std::abs(position.x) < 1e9 && std::abs(position.y) < 1e9 && std::abs(position.z) < 1e9))
      throw_lost(point);
    const bool on_faces = placement_ == Placement::Faces;
    set(position, 2, Line::Centres);
    if (on_faces) set(position, 2, Line::Faces);
    if (!owns_some(centres_[2]) && !(on_faces && owns_some(faces_[2]))) return false;
    for (int axis = 0; axis < 2; ++axis) {
      set(position, axis, Line::Centres);
      if (on_faces) set(position, axis, Line::Faces);
    }
    return true;
  }

  /// Whether parts of the kernels belong to different ranks; all ranks answer alike.
  bool is_shared() const {
    return has_several_owners(centres_[2]) ||
           (placement_ == Placement::Faces && has_several_owners(faces_[2]));
  }

  /// Calls layer(m, rows) for the layers of a component's kernel that this rank owns: the factors of a row
  /// are those of h³ δ across x, with the signs of the field's images.
  template <class Layer>
  void for_owned_layers(int component, const Symmetry& symmetry, RowWeights& x, Layer&& layer) const {
    const Stencil &y = along(component, 1), &z = along(component, 2);
    const Index3 n = grid_->cells();
    x.set(along(component, 0), symmetry[0]);
    std::array<Row, reach> rows;
    for (int m = 0; m < reach; ++m) {
      const int k = z.cell[m];
      if (k < grid_->z_begin() || k >= grid_->z_end()) continue;
      const std::size_t first_row = static_cast<std::size_t>(k - grid_->z_begin()) * n.j;
      for (int b = 0; b < reach; ++b)
        rows[b] = {(first_row + y.cell[b]) * n.i,
                   z.sign(symmetry[2], m) * y.sign(symmetry[1], b) * y.weight[b] * z.weight[m]};
      layer(m, std::span<const Row>(rows));
    }
  }

 private:
  void set(const Vec3& position, int axis, Line line) {
    Stencil& stencil = line == Line::Faces ? faces_[axis] : centres_[axis];
    make_stencil(position[axis], grid_->cells()[axis], grid_->box().boundary[axis], line, stencil);
  }
  bool owns_some(const Stencil& z) const {
    for (int m = 0; m < reach; ++m)
      if (z.cell[m] >= grid_->z_begin() && z.cell[m] < grid_->z_end()) return true;
    return false;
  }
  bool has_several_owners(const Stencil& z) const {
    const int owner = grid_->owner_of_layer(z.cell[0]);
    return std::any_of(z.cell.begin() + 1, z.cell.end(),
                       [&](int k) { return grid_->owner_of_layer(k) != owner; });
  }
  const Stencil& along(int component, int axis) const {
    return placement_ == Placement::Faces && axis == component ? faces_[axis] : centres_[axis];
  }

  const Grid* grid_;
  Placement placement_;
  std::array<Stencil, 3> centres_, faces_;
};

/// Adds force times the rows of a kernel to the values of a field.
void add_rows(std::span<const Row> rows, const RowWeights& x, double force, double* values) {
  const Stencil& s = *x.stencil;
  for (const Row& row : rows) {
    double* to = values + row.place;
    const double factor = force * row.factor;
    if (s.in_one_run) {
      Four sum;
      std::memcpy(&sum, to + s.cell[0], sizeof sum);
      sum += factor * x.weight;
      std::memcpy(to + s.cell[0], &sum, sizeof sum);
    } else {
      for (int m = 0; m < reach; ++m) to[s.cell[m]] += factor * s.weight[m] * x.sign(m);
    }
  }
}

/// Sum of the values of a field times the rows of a kernel.
double sum_of_rows(std::span<const Row> rows, const RowWeights& x, const double* values) {
  const Stencil& s = *x.stencil;
  double sum = 0;
  if (s.in_one_run) {
    Four along_x{};
    for (const Row& row : rows) {
      Four value;
      std::memcpy(&value, values + row.place + s.cell[0], sizeof value);
      along_x += row.factor * value;
    }
    const Four products = along_x * x.weight;
    for (int m = 0; m < reach; ++m) sum += products[m];
    return sum;
  }
  for (const Row& row : rows)
    for (int m = 0; m < reach; ++m)
      sum += row.factor * s.weight[m] * x.sign(m) * values[row.place + s.cell[m]];
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
  // A point whose kernels are of one rank has three sums, of which the other ranks hold none. Of the others
  // each layer has one owner, so that the sum over ranks is exact there as well; layers are then added in one
  // order, whatever the number of ranks.
  std::vector<double> sums(points.size() * 3, 0.0);
  std::vector<std::size_t> shared;
  for (std::size_t p = 0; p < points.size(); ++p) {
    const bool owns_some = kernel.move_to(points[p]);
    const bool is_shared = kernel.is_shared();
    const std::size_t first = is_shared ? sums.size() : p * 3;
    if (is_shared) {
      shared.push_back(p);
      sums.resize(sums.size() + reach * 3, 0.0);
    }
    if (!owns_some) continue;
    for (int c = 0; c < 3; ++c)
      kernel.for_owned_layers(c, u[c].symmetry(), x, [&](int m, std::span<const Row> rows) {
        sums[first + (is_shared ? m * 3 : 0) + c] += sum_of_rows(rows, x, u[c].values().data());
      });
  }
  grid.communicator().sum(sums);
  velocities.resize(points.size());
  for (std::size_t p = 0; p < points.size(); ++p)
    velocities[p] = {sums[p * 3], sums[p * 3 + 1], sums[p * 3 + 2]};
  const double* of_layer = sums.data() + points.size() * 3;
  for (const std::size_t p : shared)
    for (int m = 0; m < reach; ++m)
      for (int c = 0; c < 3; ++c) velocities[p][c] += *of_layer++;
}

}  // namespace spume::grid
