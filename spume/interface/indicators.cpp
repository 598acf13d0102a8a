#include "spume/interface/indicators.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <utility>

#include "spume/base/contract.hpp"
#include "spume/grid/spectral_filter.hpp"
#include "spume/interface/profile.hpp"
#include "spume/mesh/phase_frames.hpp"

namespace spume::interface {

namespace {

/// Six-point quadrature on a triangle, exact to degree 4 (Dunavant 1985); weights add up to one.
struct QuadraturePoint {
  std::array<double, 3> barycentric;
  double weight;
};
constexpr double a1 = 0.445948490915965, b1 = 0.108103018168070, w1 = 0.223381589678011;
constexpr double a2 = 0.091576213509771, b2 = 0.816847572980459, w2 = 0.109951743655322;
constexpr std::array<QuadraturePoint, 6> quadrature{{{{a1, a1, b1}, w1},
                                                     {{a1, b1, a1}, w1},
                                                     {{b1, a1, a1}, w1},
                                                     {{a2, a2, b2}, w2},
                                                     {{a2, b2, a2}, w2},
                                                     {{b2, a2, a2}, w2}}};

/// A curved triangle at a point of the quadrature: the shape functions of its corners and of the midpoints of
/// its edges, and what turns these nodes into tangents along two sides.
struct ShapeValues {
  std::array<double, 6> value, along_first, along_second;
  double weight;
};
constexpr ShapeValues shape_values(const QuadraturePoint& point) {
  const auto [p, q, r] = point.barycentric;
  return {{p * (2 * p - 1), q * (2 * q - 1), r * (2 * r - 1), 4 * p * q, 4 * q * r, 4 * r * p},
          {1 - 4 * p, 4 * q - 1, 0, 4 * (p - q), 4 * r, -4 * r},
          {1 - 4 * p, 0, 4 * r - 1, -4 * q, 4 * q, 4 * (p - r)},
          point.weight};
}
constexpr std::array<ShapeValues, 6> shapes{shape_values(quadrature[0]), shape_values(quadrature[1]),
                                            shape_values(quadrature[2]), shape_values(quadrature[3]),
                                            shape_values(quadrature[4]), shape_values(quadrature[5])};

using Nodes = std::array<Vec3, 6>;  // of a curved triangle

Nodes nodes(const mesh::FilmMesh& films, int t, const EdgeMidpoints& midpoints) {
  const auto [a, b, c] = films.corners(t);
  return {a, b, c, midpoints[0], midpoints[1], midpoints[2]};
}

Vec3 combined(const std::array<double, 6>& factor, const Nodes& node) {
  Vec3 sum = factor[0] * node[0];
  for (int n = 1; n < 6; ++n) sum += factor[n] * node[n];
  return sum;
}

/// A point of a curved triangle and its share of the area vector [m²].
struct AreaPoint {
  Vec3 place, area;
};
using AreaPoints = std::array<AreaPoint, 6>;

/// Area vectors are quadratic over the triangle, so their sum is exact, and so are the volumes of cones.
AreaPoints area_points(const Nodes& node) {
  AreaPoints points;
  for (std::size_t n = 0; n < points.size(); ++n) {
    const ShapeValues& shape = shapes[n];
    points[n] = {
        combined(shape.value, node),
        (0.5 * shape.weight) * cross(combined(shape.along_first, node), combined(shape.along_second, node))};
  }
  return points;
}

using Eight = double __attribute__((vector_size(64)));  // one instruction's worth, or a few
constexpr int vector_length = 8;

/// Weights of a point along one direction on the five cells around it: of the quadratic B-spline at cell
/// centres, and of the difference of the cubic B-spline between the two faces of each cell.
struct LineWeights {
  int first;
  std::array<double, 5> value, difference;
};

LineWeights line_weights(double place) {  // in cells from the lower face of the box
  LineWeights w;
  const int cell = static_cast<int>(std::floor(place));
  const double t = place - cell;  // 0 … 1 inside the cell
  w.first = cell - 2;
  w.value = {0, 0.5 * (1 - t) * (1 - t), 0.75 - (t - 0.5) * (t - 0.5), 0.5 * t * t, 0};
  const double r = 1 - t;
  const std::array<double, 4> face{r * r * r / 6, 2.0 / 3 - t * t + 0.5 * t * t * t,
                                   2.0 / 3 - r * r + 0.5 * r * r * r, t * t * t / 6};
  w.difference = {face[0], face[1] - face[0], face[2] - face[1], face[3] - face[2], -face[3]};
  return w;
}

/// Five weights as a vector that starts `shift` places before them.
Eight shifted(const std::array<double, 5>& weights, int shift) {
  std::array<double, 2 * vector_length> places{};
  std::copy(weights.begin(), weights.end(), places.begin() + shift);
  Eight vector;
  std::memcpy(&vector, places.data(), sizeof vector);
  return vector;
}

/// The divergence of the fluxes through one curved triangle on the cells around it, before it goes to the
/// fields of two phases: the points of a triangle share most of their cells.
class TriangleSpread {
 public:
  explicit TriangleSpread(const grid::Grid& grid)
      : lower_(grid.box().lower),
        per_h_(1 / grid.h()),
        per_h4_(std::pow(per_h_, 4)),
        lattice_(lattice_of(grid.box())) {}

  /// Takes the fluxes through a triangle in place of those before.
  void take(const AreaPoints& points) {
    Vec3 lowest = points[0].place, highest = lowest;
    for (const AreaPoint& point : points)
      for (int d = 0; d < 3; ++d) {
        lowest[d] = std::min(lowest[d], point.place[d]);
        highest[d] = std::max(highest[d], point.place[d]);
      }
    for (int d = 0; d < 3; ++d) {
      first_[d] = static_cast<int>(std::floor(per_h_ * (lowest[d] - lower_[d]))) - 2;
      last_[d] = static_cast<int>(std::floor(per_h_ * (highest[d] - lower_[d]))) + 3;
    }
    n_vectors_ = (last_.i - first_.i + vector_length - 1) / vector_length;
    value_.assign(static_cast<std::size_t>(n_vectors_) * (last_.j - first_.j) * (last_.k - first_.k),
                  Eight{});
    for (const AreaPoint& point : points) add(point.place, -point.area);
  }

  /// Adds what came together, times `sign`, to the values of a block, which holds all of it.
  void give(double sign, const CellBox& block, std::span<double> values) const {
    const int n = last_.i - first_.i, size = block.end.i - block.begin.i;
    const int start = lattice_.image(first_.i, block.begin.i, 0) - block.begin.i;
    const Eight* from = value_.data();
    for (int k = first_.k; k < last_.k; ++k)
      for (int j = first_.j; j < last_.j; ++j, from += n_vectors_) {
        const Index3 place{block.begin.i, lattice_.image(j, block.begin.j, 1),
                           lattice_.image(k, block.begin.k, 2)};
        double* row = &values[block.offset(place.i, place.j, place.k)];
        if (start + n_vectors_ * vector_length <= size) {  // also the zeros behind the last cell
          for (int m = 0; m < n_vectors_; ++m) add_to(row + start + m * vector_length, sign * from[m]);
          continue;
        }
        for (int i = 0; i < n; ++i)
          row[(start + i) % size] += sign * from[i / vector_length][i % vector_length];
      }
  }

 private:
  static void add_to(double* to, const Eight& term) {
    Eight sum;
    std::memcpy(&sum, to, sizeof sum);
    sum += term;
    std::memcpy(to, &sum, sizeof sum);
  }

  /// Adds the flux [m²] at x.
  void add(const Vec3& x, const Vec3& flux) {
    const Vec3 place = per_h_ * (x - lower_);
    const LineWeights wx = line_weights(place.x), wy = line_weights(place.y), wz = line_weights(place.z);
    // Five places in one vector, or, in a long row, in two.
    const int offset = wx.first - first_.i;
    const int vector = offset / vector_length, shift = offset % vector_length;
    const bool in_two = shift + 5 > vector_length;
    const Eight value = shifted(wx.value, shift), difference = shifted(wx.difference, shift);
    Eight next_value{}, next_difference{};
    if (in_two)
      for (int m = vector_length - shift; m < 5; ++m) {
        next_value[m + shift - vector_length] = wx.value[m];
        next_difference[m + shift - vector_length] = wx.difference[m];
      }
    const Vec3 f = per_h4_ * flux;  // flux density on faces (1/h³), and its difference over h
    const int n_rows = last_.j - first_.j;
    for (int c = 0; c < 5; ++c) {
      Eight* row =
          &value_[(static_cast<std::size_t>(wz.first + c - first_.k) * n_rows + wy.first - first_.j) *
                      n_vectors_ +
                  vector];
      const double fx = f.x * wz.value[c], fy = f.y * wz.value[c], fz = f.z * wz.difference[c];
      for (int b = 0; b < 5; ++b, row += n_vectors_) {
        const double across = fx * wy.value[b];
        const double along = fy * wy.difference[b] + fz * wy.value[b];
        row[0] += across * difference + along * value;
        if (in_two) row[1] += across * next_difference + along * next_value;
      }
    }
  }

  Vec3 lower_;
  double per_h_, per_h4_;
  Lattice lattice_;
  Index3 first_{}, last_{};
  int n_vectors_ = 0;  ///< of a row along x
  std::vector<Eight> value_;
};

/// The rank that computes each phase, or −1 where it has no cells: neighbours along z together, since a film
/// between bubbles of two ranks is spread by both, and rooms of about as many cells for each rank.
std::vector<int> owners(const PhaseBlocks& blocks, int n_ranks) {
  std::vector<std::size_t> phases;
  double all = 0;
  for (std::size_t p = 0; p < blocks.cells.size(); ++p)
    if (!blocks.cells[p].empty()) {
      phases.push_back(p);
      all += static_cast<double>(blocks.room[p].size());
    }
  const auto doubled_height = [&](std::size_t p) { return blocks.cells[p].begin.k + blocks.cells[p].end.k; };
  std::ranges::stable_sort(phases, {}, doubled_height);
  std::vector<int> owner(blocks.cells.size(), -1);
  double before = 0;
  for (const std::size_t p : phases) {
    const auto size = static_cast<double>(blocks.room[p].size());
    owner[p] = std::min(n_ranks - 1, static_cast<int>(n_ranks * (before + 0.5 * size) / all));
    before += size;
  }
  return owner;
}

/// The fields of the bubbles that this rank computes, on their rooms.
struct OwnFields {
  std::vector<std::optional<grid::Field>> divergence;  ///< by phase
  std::vector<double> volume;                          ///< [m³]
};

/// Spreads the films of this rank's bubbles and finds their volumes.
void spread_films(const grid::Grid& grid, const mesh::FilmMesh& films,
                  const std::vector<EdgeMidpoints>& midpoints, const PhaseBlocks& blocks, OwnFields& own) {
  TriangleSpread spread(grid);
  const auto n_phases = static_cast<mesh::Phase>(blocks.cells.size());
  const mesh::PhaseFrames frames(films, n_phases);
  std::vector<double> cones(n_phases, 0.0);
  for (int t = 0; t < films.n_triangles(); ++t) {
    const mesh::FilmTriangle& triangle = films.triangle[t];
    if (!own.divergence[triangle.phase_a] && !own.divergence[triangle.phase_b]) continue;
    const AreaPoints points = area_points(nodes(films, t, midpoints[t]));
    spread.take(points);
    for (const auto& [phase, sign] : {std::pair(triangle.phase_a, 1.0), std::pair(triangle.phase_b, -1.0)}) {
      if (!own.divergence[phase]) continue;
      spread.give(sign, blocks.room[phase], own.divergence[phase]->values());
      for (const auto& [x, area] : points) cones[phase] += sign * frames.cone(phase, x, area);
    }
  }
  own.volume.assign(n_phases, 0.0);
  for (mesh::Phase p = 0; p < n_phases; ++p)
    if (own.divergence[p]) own.volume[p] = frames.volume(p, cones[p]);
}

double sinc_cubed(double x) {
  const double s = x == 0 ? 1 : std::sin(x) / x;
  return s * s * s;
}

/// What each mode along one axis contributes to the factor of the indicator filter.
struct AxisFactors {
  std::vector<double> laplacian;  ///< of −∇²_h [1/m²]
  std::vector<double> z;          ///< s k²/2
  std::vector<double> other;      ///< e^{−z} over the B-spline's sinc³
};
AxisFactors axis_factors(std::span<const double> theta, double h, double variance) {
  AxisFactors factors;
  for (const double angle : theta) {
    factors.laplacian.push_back((2 - 2 * std::cos(angle)) / (h * h));
    factors.z.push_back(0.5 * variance * angle * angle / (h * h));
    factors.other.push_back(std::exp(-factors.z.back()) / sinc_cubed(0.5 * angle));
  }
  return factors;
}

/// From the divergence of the spread fluxes to smoothed indicators without their mean.
grid::SpectralFilter indicator_filter(const grid::Grid& grid, double variance) {
  const double h = grid.h();
  using Filter = grid::SpectralFilter;
  return {grid, grid::even_symmetry, [h, variance](const Filter::AxisAngles& theta) -> Filter::FactorOfRow {
            return [x = axis_factors(theta[0], h, variance), y = axis_factors(theta[1], h, variance),
                    z = axis_factors(theta[2], h, variance)](int j, int k, std::span<double> factors) {
              const double laplacian = y.laplacian[j] + z.laplacian[k], z_yz = y.z[j] + z.z[k],
                           other = -y.other[j] * z.other[k];
              for (std::size_t i = 0; i < factors.size(); ++i)
                factors[i] =
                    smoothing_polynomial(x.z[i] + z_yz) * other * x.other[i] / (x.laplacian[i] + laplacian);
              if (!(x.laplacian[0] + laplacian > 0)) factors[0] = 0;  // the mean, given by the volume
            };
          }};
}

/// Rooms of one size share a grid, periodic in itself, and what is tabulated for it. All cells of the box
/// have its boundaries.
class Rooms {
 public:
  Rooms(const grid::Box& box, double variance) : box_(box), variance_(variance) {}

  struct Room {
    Room(const grid::Box& box, double variance)
        : grid(parallel::Communicator::self(), box), filter(indicator_filter(grid, variance)) {}
    grid::Grid grid;
    grid::SpectralFilter filter;
  };
  const Room& of(const CellBox& cells) {
    const bool is_whole = cells.begin == Index3{} && cells.end == box_.cells;
    const std::array<int, 4> key{cells.end.i - cells.begin.i, cells.end.j - cells.begin.j,
                                 cells.end.k - cells.begin.k, is_whole};
    auto& room = room_[key];
    if (!room) room = std::make_unique<Room>(is_whole ? box_ : periodic_box(key), variance_);
    return *room;
  }

 private:
  grid::Box periodic_box(const std::array<int, 4>& size) const {
    const double h = box_.spacing();
    return {{}, {h * size[0], h * size[1], h * size[2]}, {size[0], size[1], size[2]}};
  }

  grid::Box box_;
  double variance_;
  std::map<std::array<int, 4>, std::unique_ptr<Room>> room_;
};

/// The smallest even number not below n whose transform is quick.
int transform_size(int n) {
  const auto is_quick = [](int size) {
    for (int factor : {2, 3, 5})
      while (size % factor == 0) size /= factor;
    return size == 1;
  };
  n += n % 2;
  while (!is_quick(n)) n += 2;
  return n;
}

/// The part of a field on `room` that lies on `cells`.
std::vector<double> cut_out(const grid::Field& field, const CellBox& room, const CellBox& cells) {
  std::vector<double> values;
  values.reserve(cells.size());
  for (int k = cells.begin.k; k < cells.end.k; ++k)
    for (int j = cells.begin.j; j < cells.end.j; ++j) {
      const auto row = field.values().begin() + static_cast<std::ptrdiff_t>(room.offset(cells.begin.i, j, k));
      values.insert(values.end(), row, row + (cells.end.i - cells.begin.i));
    }
  return values;
}

}  // namespace

PhaseBlocks blocks_of_phases(const grid::Grid& grid, const mesh::FilmMesh& films, int n_phases) {
  constexpr int reach = 8;
  PhaseBlocks blocks;
  blocks.cells.assign(n_phases, no_cells());
  blocks.room.assign(n_phases, no_cells());
  const Lattice lattice = lattice_of(grid.box());
  const mesh::PhaseFrames frames(films, n_phases);
  for (int p = 1; p < n_phases; ++p) {
    const Vec3 lower = (frames.lower(p) - grid.box().lower) / grid.h(),
               upper = (frames.upper(p) - grid.box().lower) / grid.h();
    if (!(lower.x <= upper.x)) continue;  // no films
    CellBox &cells = blocks.cells[p], &room = blocks.room[p];
    if (!frames.bounded(p, 0) || !frames.bounded(p, 1) || !frames.bounded(p, 2)) {
      cells = room = all_cells(grid.cells());
      continue;
    }
    for (int d = 0; d < 3; ++d) {
      cells.begin[d] = static_cast<int>(std::floor(lower[d]));
      cells.end[d] = static_cast<int>(std::floor(upper[d])) + 1;
      room.begin[d] = cells.begin[d] - reach;
      const int size = transform_size(cells.end[d] + reach - room.begin[d]);
      room.end[d] = room.begin[d] + size;
    }
    cells = lattice.grown(cells, reach);
    for (int d = 0; d < 3; ++d)
      if (lattice.periodic[d] && room.end[d] - room.begin[d] >= lattice.cells[d]) {
        room.begin[d] = cells.begin[d];
        room.end[d] = cells.begin[d] + lattice.cells[d];
      }
  }
  return blocks;
}

std::vector<std::vector<double>> smoothed_indicators(const grid::Grid& grid, const mesh::FilmMesh& films,
                                                     const std::vector<EdgeMidpoints>& midpoints,
                                                     const PhaseBlocks& blocks, double variance) {
  expects(midpoints.size() == films.triangle.size(), "one set of midpoints a triangle");
  const parallel::Communicator& ranks = grid.communicator();
  const std::size_t n_phases = blocks.cells.size();
  const std::vector<int> owner = owners(blocks, ranks.size());
  Rooms rooms(grid.box(), variance);
  OwnFields own{std::vector<std::optional<grid::Field>>(n_phases), {}};
  for (std::size_t p = 0; p < n_phases; ++p)
    if (owner[p] == ranks.rank()) own.divergence[p].emplace(rooms.of(blocks.room[p]).grid);
  spread_films(grid, films, midpoints, blocks, own);

  std::vector<std::vector<double>> indicators(n_phases);
  for (std::size_t p = 0; p < n_phases; ++p) {
    if (!own.divergence[p]) continue;
    grid::Field& field = *own.divergence[p];
    const Rooms::Room& room = rooms.of(blocks.room[p]);
    room.filter.apply(field, field);
    indicators[p] = cut_out(field, blocks.room[p], blocks.cells[p]);
    own.divergence[p].reset();
    const double mean = own.volume[p] / room.grid.box().domain().volume();
    for (double& value : indicators[p]) value += mean;
  }
  if (ranks.size() > 1)
    for (std::size_t p = 0; p < n_phases; ++p) {
      if (owner[p] < 0) continue;
      indicators[p].resize(blocks.cells[p].size());
      ranks.broadcast(indicators[p], owner[p]);
    }
  return indicators;
}

}  // namespace spume::interface
