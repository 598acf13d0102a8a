#include "spume/interface/potentials.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <limits>
#include <utility>

#include "spume/base/contract.hpp"
#include "spume/interface/profile.hpp"

namespace spume::interface {

namespace {

/// Weights of cubic Lagrange interpolation from the points −1, 0, 1, 2 to t in [0, 1), and of its derivative.
struct CubicWeights {
  std::array<double, 4> value, slope;
};

CubicWeights cubic_weights(double t) {
  return {{-t * (t - 1) * (t - 2) / 6, (t + 1) * (t - 1) * (t - 2) / 2, -(t + 1) * t * (t - 2) / 2,
           (t + 1) * t * (t - 1) / 6},
          {-(3 * t * t - 6 * t + 2) / 6, (3 * t * t - 4 * t - 1) / 2, -(3 * t * t - 2 * t - 2) / 2,
           (3 * t * t - 1) / 6}};
}

/// 4 × 4 × 4 values of a field: where they begin, and the distances between rows and planes.
struct ValueBlock {
  const double* first;
  std::ptrdiff_t stride_y, stride_z;
};

/// The values from cell (i, j, k) on; copied into `room` where the block is not in one piece inside the
/// field's cells.
ValueBlock values_at(const PhaseField& f, int i, int j, int k, std::array<double, 64>& room) {
  const CellBox& c = f.cells;
  const Index3 start = f.lattice.image_in(c, i, j, k);
  if (c.contains(start.i, start.j, start.k) && c.contains(start.i + 3, start.j + 3, start.k + 3))
    return {&f.value[c.offset(start.i, start.j, start.k)], c.stride_y(), c.stride_z()};
  double* to = room.data();
  for (int z = 0; z < 4; ++z)
    for (int y = 0; y < 4; ++y)
      for (int x = 0; x < 4; ++x) *to++ = f.at(i + x, j + y, k + z);
  return {room.data(), 4, 16};
}

bool is_near(const Vec3& x, const Vec3& start, double reach) {
  return norm_squared(x - start) <= reach * reach;
}

}  // namespace

void PhasePotentials::set(PhaseField field) {
  expects(field.phase >= 0 && field.value.size() == field.cells.size(), "a field fills its cells");
  field.lattice = lattice_;
  const auto place = std::lower_bound(fields_.begin(), fields_.end(), field.phase,
                                      [](const PhaseField& f, mesh::Phase p) { return f.phase < p; });
  if (place != fields_.end() && place->phase == field.phase)
    *place = std::move(field);
  else
    fields_.insert(place, std::move(field));
  place_of_phase_.assign(fields_.back().phase + 1, -1);
  for (std::size_t n = 0; n < fields_.size(); ++n) place_of_phase_[fields_[n].phase] = static_cast<int>(n);
}

const PhaseField* PhasePotentials::find(mesh::Phase phase) const {
  if (phase < 0 || phase >= static_cast<int>(place_of_phase_.size()) || place_of_phase_[phase] < 0)
    return nullptr;
  return &fields_[place_of_phase_[phase]];
}
PhaseField* PhasePotentials::find(mesh::Phase phase) {
  return const_cast<PhaseField*>(std::as_const(*this).find(phase));
}

void PhasePotentials::raise(mesh::Phase phase, double amount) {
  PhaseField* field = find(phase);
  expects(field, "only a phase with a field can be raised");
  field->beyond += amount;
  for (double& value : field->value) value += amount;
}

double PhasePotentials::difference(const PhaseField& a, const PhaseField& b, const Vec3& x,
                                   Vec3& gradient) const {
  const double per_h = 1 / h();
  const Vec3 place = per_h * (x - box_.lower) - Vec3{0.5, 0.5, 0.5};
  const int i = static_cast<int>(std::floor(place.x)), j = static_cast<int>(std::floor(place.y)),
            k = static_cast<int>(std::floor(place.z));
  const CubicWeights wx = cubic_weights(place.x - i), wy = cubic_weights(place.y - j),
                     wz = cubic_weights(place.z - k);
  std::array<double, 64> room_a, room_b;
  const ValueBlock va = values_at(a, i - 1, j - 1, k - 1, room_a),
                   vb = values_at(b, i - 1, j - 1, k - 1, room_b);
  // Sums over z and y for the four places along x at a time.
  using Line = double __attribute__((vector_size(32)));
  Line value{}, slope_y{}, slope_z{};
  for (int c = 0; c < 4; ++c) {
    Line plane{}, plane_y{};
    for (int m = 0; m < 4; ++m) {
      const double *pa = va.first + c * va.stride_z + m * va.stride_y,
                   *pb = vb.first + c * vb.stride_z + m * vb.stride_y;
      Line row_a, row_b;
      std::memcpy(&row_a, pa, sizeof row_a);
      std::memcpy(&row_b, pb, sizeof row_b);
      const Line v = row_a - row_b;
      plane += wy.value[m] * v;
      plane_y += wy.slope[m] * v;
    }
    value += wz.value[c] * plane;
    slope_y += wz.value[c] * plane_y;
    slope_z += wz.slope[c] * plane;
  }
  const auto along_x = [](const std::array<double, 4>& w, const Line& line) {
    return w[0] * line[0] + w[1] * line[1] + w[2] * line[2] + w[3] * line[3];
  };
  gradient =
      (0.5 * per_h) * Vec3{along_x(wx.slope, value), along_x(wx.value, slope_y), along_x(wx.value, slope_z)};
  return 0.5 * along_x(wx.value, value);
}

std::optional<Vec3> PhasePotentials::project(const Vec3& x, const mesh::PhaseSet& phases) const {
  std::array<const PhaseField*, 4> field{};
  const int n = std::min(phases.size(), 4);
  for (int m = 0; m < n; ++m) {
    field[m] = find(phases[m]);
    if (!field[m]) return std::nullopt;
  }
  if (n == 2) return project_on_film(x, field.data());
  if (n == 3) return project_on_border(x, field.data());
  if (n == 4) return project_on_junction(x, field.data());
  return std::nullopt;
}

std::optional<Vec3> PhasePotentials::project_on_film(const Vec3& start,
                                                     const PhaseField* const* field) const {
  constexpr int n_iterations = 5;
  constexpr double reach = 0.5, smallest_gradient = 0.2, converged = 1e-10;  // lengths in h
  Vec3 x = start, g;
  for (int n = 0; n < n_iterations; ++n) {
    const double s = difference(*field[0], *field[1], x, g);
    const double g2 = norm_squared(g);
    if (!(g2 > smallest_gradient * smallest_gradient)) return std::nullopt;
    x -= (s / g2) * g;
    if (!is_near(x, start, 2 * reach * h())) return std::nullopt;
    if (std::abs(s) < converged * h()) break;
  }
  if (!is_near(x, start, reach * h())) return std::nullopt;
  return x;
}

std::optional<Vec3> PhasePotentials::project_on_border(const Vec3& start,
                                                       const PhaseField* const* field) const {
  constexpr int n_iterations = 6;
  constexpr double reach = 0.8, smallest_gradient = 0.2, smallest_sine_squared = 0.02, converged = 1e-10;
  Vec3 x = start, g1, g2;
  for (int n = 0; n < n_iterations; ++n) {
    const double s1 = difference(*field[0], *field[1], x, g1), s2 = difference(*field[0], *field[2], x, g2);
    const double a = norm_squared(g1), b = dot(g1, g2), c = norm_squared(g2), determinant = a * c - b * b;
    const double floor = smallest_gradient * smallest_gradient;
    if (!(determinant > smallest_sine_squared * a * c && a > floor && c > floor)) return std::nullopt;
    x -= (c * s1 - b * s2) / determinant * g1 + (a * s2 - b * s1) / determinant * g2;
    if (!is_near(x, start, reach * h())) return std::nullopt;
    if (std::abs(s1) + std::abs(s2) < converged * h()) break;
  }
  return x;
}

std::optional<Vec3> PhasePotentials::project_on_junction(const Vec3& start,
                                                         const PhaseField* const* field) const {
  constexpr int n_iterations = 8;
  constexpr double reach = 0.5, smallest_volume = 0.05, converged = 1e-10;
  Vec3 x = start;
  for (int n = 0; n < n_iterations; ++n) {
    std::array<Vec3, 3> g;
    std::array<double, 3> s;
    for (int m = 0; m < 3; ++m) s[m] = difference(*field[0], *field[m + 1], x, g[m]);
    const double determinant = dot(g[0], cross(g[1], g[2]));
    if (!(std::abs(determinant) > smallest_volume * norm(g[0]) * norm(g[1]) * norm(g[2])))
      return std::nullopt;
    const Vec3 move =
        (s[0] * cross(g[1], g[2]) + s[1] * cross(g[2], g[0]) + s[2] * cross(g[0], g[1])) / determinant;
    x -= move;
    if (!is_near(x, start, reach * h())) return std::nullopt;
    if (norm(move) < converged * h()) break;
  }
  return x;
}

int PhasePotentials::handedness(const Vec3& x, const mesh::PhaseSet& phases) const {
  std::array<Vec3, 3> g;
  const PhaseField* first = find(phases[0]);
  for (int m = 0; m < 3; ++m) {
    const PhaseField* other = find(phases[m + 1]);
    if (!first || !other) return 0;
    difference(*first, *other, x, g[m]);
  }
  const double volume = dot(g[0], cross(g[1], g[2]));
  return (volume > 0) - (volume < 0);
}

PhasePotentials potentials_of(const grid::Box& box, std::span<const CellBox> cells,
                              std::vector<std::vector<double>> indicator, double variance, double floor) {
  const FlatFilmMap map(variance, floor);
  const CellBox whole = all_cells(box.cells);
  PhasePotentials potentials(box);
  PhaseField outside{0, whole, map.distance(0), std::vector<double>(whole.size(), 1.0)};
  for (std::size_t p = 0; p < cells.size(); ++p)
    for_each_cell_of_grid(cells[p], potentials.lattice(),
                          [&](std::size_t n, std::size_t cell) { outside.value[cell] -= indicator[p][n]; });
  map.to_distances(outside.value);
  potentials.set(std::move(outside));

  for (std::size_t p = 0; p < cells.size(); ++p) {
    if (cells[p].empty()) continue;
    PhaseField field{static_cast<mesh::Phase>(p), cells[p], map.distance(0), std::move(indicator[p])};
    map.to_distances(field.value);
    potentials.set(std::move(field));
  }
  return potentials;
}

std::vector<mesh::Phase> find_winners(const PhasePotentials& potentials,
                                      const parallel::Communicator& ranks) {
  const Lattice& lattice = potentials.lattice();
  const CellBox whole = all_cells(lattice.cells);
  const std::size_t layer_size = whole.size() / lattice.cells.k;
  std::vector<int> share = ranks.shares(lattice.cells.k);
  const int first = share[ranks.rank()], end = share[ranks.rank() + 1];
  std::vector<mesh::Phase> winner(whole.size(), 0);
  std::vector<double> largest((end - first) * layer_size, -std::numeric_limits<double>::max());
  for (const auto& field : potentials.fields()) {
    CellBox layer = field.cells;
    const double* value = field.value.data();
    for (int k = field.cells.begin.k; k < field.cells.end.k; ++k, value += layer.size()) {
      layer.begin.k = k;
      layer.end.k = k + 1;
      if (const int image = lattice.image(k, 0, 2); image < first || image >= end) continue;
      for_each_cell_of_grid(layer, lattice, [&](std::size_t n, std::size_t cell) {
        double& known = largest[cell - first * layer_size];
        const bool wins = value[n] > known;
        known = wins ? value[n] : known;
        winner[cell] = wins ? field.phase : winner[cell];
      });
    }
  }
  for (int& cell : share) cell *= static_cast<int>(layer_size);
  ranks.all_gather(std::span(winner), share);
  return winner;
}

std::vector<double> leads_of_winners(const PhasePotentials& potentials) {
  const CellBox whole = all_cells(potentials.box().cells);
  constexpr double none = -std::numeric_limits<double>::max();
  double lowest = 0;
  std::vector<double> first(whole.size(), none), second(whole.size(), none);
  for (const auto& field : potentials.fields()) {
    lowest = std::min(lowest, field.beyond);
    for_each_cell_of_grid(field.cells, potentials.lattice(), [&](std::size_t n, std::size_t cell) {
      second[cell] = std::max(second[cell], std::min(first[cell], field.value[n]));
      first[cell] = std::max(first[cell], field.value[n]);
    });
  }
  for (std::size_t c = 0; c < first.size(); ++c) first[c] -= second[c] > none ? second[c] : lowest;
  return first;
}

}  // namespace spume::interface
