#include "spume/grid/kernel_coupling.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <numeric>
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

/// Where a point lies in units of cells.
Vec3 position_of(const Vec3& point, const Grid& grid) {
  const Vec3 position = (point - grid.box().lower) / grid.h();
  // Also false for NaN. Farther points would not fit an int.
  if (!(std::abs(position.x) < 1e9 && std::abs(position.y) < 1e9 && std::abs(position.z) < 1e9))
    throw_lost(point);
  return position;
}

/// Who owns the values under the kernels of a point.
class Owners {
 public:
  static constexpr int several = -1;

  explicit Owners(const Grid& grid) : grid_(grid), of_layer_(grid.cells().k, several) {
    const int n_around = reach / 2;  // layers to both sides of that of the point
    for (int k = n_around; k + n_around < grid.cells().k; ++k)
      if (const int owner = grid.owner_of_layer(k - n_around); owner == grid.owner_of_layer(k + n_around))
        of_layer_[k] = owner;
  }

  /// The rank that owns all of them; `several` also where the kernels may reach beyond the ends of the box
  /// along z. All ranks answer alike.
  int of(const Vec3& point) const {
    if (grid_.communicator().size() == 1) return 0;
    const double z = position_of(point, grid_).z;
    return z >= 0 && z < grid_.cells().k ? of_layer_[static_cast<std::size_t>(z)] : several;
  }

 private:
  const Grid& grid_;
  std::vector<int> of_layer_;  ///< of cells that points are in
};

/// The kernels of a point for the three components of a vector field, and the part of them that a rank owns.
class Kernel {
 public:
  Kernel(const Grid& grid, const KernelCoupling& coupling) : grid_(&grid), placement_(coupling.placement) {}

  /// Takes a point; false where this rank owns nothing of its kernels.
  bool move_to(const Vec3& point) {
    const Vec3 position = position_of(point, *grid_);
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

using Sums = std::array<double, 3>;  // of the components

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
  const parallel::Communicator& ranks = grid.communicator();
  const Owners owners(grid);
  std::vector<int> owner(points.size()), first_of(ranks.size() + 1, 0);
  int n_shared = 0;
  for (std::size_t p = 0; p < points.size(); ++p) {
    owner[p] = owners.of(points[p]);
    ++(owner[p] == Owners::several ? n_shared : first_of[owner[p] + 1]);
  }
  std::partial_sum(first_of.begin(), first_of.end(), first_of.begin());

  // The points of one rank have one sum a component. Those of several have one a layer, which has one owner,
  // so that the sum over ranks is exact; layers are then added in one order, whatever the number of ranks.
  std::vector<Sums> sum(first_of.back(), Sums{});
  std::vector<double> layer_sum(static_cast<std::size_t>(n_shared) * reach * 3, 0.0);
  Sums* alone = sum.data() + first_of[ranks.rank()];
  double* shared = layer_sum.data();
  Kernel kernel(grid, *this);
  RowWeights x;
  for (std::size_t p = 0; p < points.size(); ++p) {
    const bool is_shared = owner[p] == Owners::several;
    if (!is_shared && owner[p] != ranks.rank()) continue;
    double* const to = is_shared ? shared : (alone++)->data();
    if (is_shared) shared += reach * 3;
    if (!kernel.move_to(points[p])) continue;
    for (int c = 0; c < 3; ++c)
      kernel.for_owned_layers(c, u[c].symmetry(), x, [&](int m, std::span<const Row> rows) {
        to[(is_shared ? m * 3 : 0) + c] += sum_of_rows(rows, x, u[c].values().data());
      });
  }
  ranks.all_gather(std::span(sum), first_of);
  ranks.sum(layer_sum);

  velocities.assign(points.size(), Vec3{});
  shared = layer_sum.data();
  for (std::size_t p = 0; p < points.size(); ++p) {
    Vec3& velocity = velocities[p];
    if (owner[p] != Owners::several) {
      const auto& [u_x, u_y, u_z] = sum[first_of[owner[p]]++];
      velocity = {u_x, u_y, u_z};
      continue;
    }
    for (int m = 0; m < reach; ++m)
      for (int c = 0; c < 3; ++c) velocity[c] += *shared++;
  }
}

}  // namespace spume::grid
