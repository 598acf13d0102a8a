#pragma once

#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include "spume/viim/distance_field.hpp"

namespace spume::viim::testing {

inline constexpr double h = 1e-4;  ///< cell of all tests [m]

inline grid::Box cube_box(int cells) {
  return {{-0.5 * cells * h, -0.5 * cells * h, -0.5 * cells * h},
          {0.5 * cells * h, 0.5 * cells * h, 0.5 * cells * h},
          {cells, cells, cells}};
}

/// Half-planes that meet in a line parallel to z through `junction`, at increasing angles from the x axis;
/// phase n lies between the angles n and n + 1.
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

/// φ and χ of functions of a point, φ as far as the band goes.
template <class Distance, class Phase>
DistanceField sampled(const grid::Box& box, Distance distance, Phase phase) {
  DistanceField field{box, {}, {}};
  interface::for_each_cell(interface::all_cells(box.cells), [&](int i, int j, int k) {
    const Vec3 x = box.lower + box.spacing() * Vec3{i + 0.5, j + 0.5, k + 0.5};
    field.distance.push_back(std::min(distance(x), band_cells * box.spacing()));
    field.phase.push_back(phase(x));
  });
  return field;
}

inline DistanceField sampled(const grid::Box& box, const StraightFilms& films) {
  return sampled(
      box, [&](const Vec3& x) { return films.distance(x); }, [&](const Vec3& x) { return films.phase(x); });
}

}  // namespace spume::viim::testing
