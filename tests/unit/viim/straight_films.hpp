#pragma once

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "spume/viim/distance_field.hpp"

namespace spume::viim::testing {

inline constexpr double h = 1e-4;  ///< cell of all tests [m], unless they refine
inline constexpr double degrees = std::numbers::pi / 180;

/// A box around the origin with its edges `half_width` [m] away.
inline grid::Box cube_box(double half_width, int cells) {
  return {
      {-half_width, -half_width, -half_width}, {half_width, half_width, half_width}, {cells, cells, cells}};
}

/// Its faces are walls, for films that go to its edge.
inline grid::Box walled(grid::Box box) {
  box.boundary.fill(grid::Boundary::Slip);
  return box;
}

/// Half-planes that meet in a line parallel to z through `junction`, at increasing angles [rad] from the x
/// axis; phase n lies between the angles n and n + 1.
struct StraightFilms {
  Vec3 junction;
  std::vector<double> angle;

  mesh::Phase phase(const Vec3& x) const {
    const double turn = 2 * std::numbers::pi;
    double a = std::atan2(x.y - junction.y, x.x - junction.x) - angle[0];
    a -= turn * std::floor(a / turn);
    mesh::Phase p = 0;
    while (p + 1 < static_cast<int>(angle.size()) && a >= angle[p + 1] - angle[0]) ++p;
    return p;
  }
  double distance(const Vec3& x) const {
    const double rx = x.x - junction.x, ry = x.y - junction.y;
    double nearest = std::hypot(rx, ry);
    for (double a : angle)
      if (rx * std::cos(a) + ry * std::sin(a) > 0)
        nearest = std::min(nearest, std::abs(ry * std::cos(a) - rx * std::sin(a)));
    return nearest;
  }
};

/// φ and χ of functions of a point.
template <class Distance, class Phase>
DistanceField sampled(const grid::Box& box, Distance distance, Phase phase) {
  DistanceField field{box, {}, {}};
  interface::for_each_cell(interface::all_cells(box.cells), [&](int i, int j, int k) {
    const Vec3 x = box.lower + box.spacing() * Vec3{i + 0.5, j + 0.5, k + 0.5};
    field.distance.push_back(distance(x));
    field.phase.push_back(phase(x));
  });
  return field;
}

inline DistanceField sampled(const grid::Box& box, const StraightFilms& films) {
  return sampled(
      box, [&](const Vec3& x) { return films.distance(x); }, [&](const Vec3& x) { return films.phase(x); });
}

/// A ball of phase 1, φ up to `far` [m].
inline DistanceField sampled_ball(const grid::Box& box, const Vec3& centre, double radius, double far) {
  return sampled(
      box, [&](const Vec3& x) { return std::min(far, std::abs(radius - norm(x - centre))); },
      [&](const Vec3& x) { return norm(x - centre) < radius ? 1 : 0; });
}

inline Vec3 centre_of_cell(const grid::Box& box, std::size_t cell) {
  const std::size_t nx = box.cells.i, ny = box.cells.j;
  return box.lower + box.spacing() * Vec3{cell % nx + 0.5, cell / nx % ny + 0.5, cell / (nx * ny) + 0.5};
}

}  // namespace spume::viim::testing
