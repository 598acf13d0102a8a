#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <ostream>
#include <string>
#include <vector>

#include "spume/base/random.hpp"
#include "spume/grid/field.hpp"
#include "spume/grid/loops.hpp"

namespace spume::grid {

/// A box away from the origin, of the size of real foams, with as many cells as are asked for.
inline Box make_box(const Index3& cells, const std::array<Boundary, 3>& boundary) {
  const double h = 2.5e-5;
  const Vec3 lower{-1e-4, 2e-4, 5e-5};
  return {lower, lower + h * Vec3{double(cells.i), double(cells.j), double(cells.k)}, cells, boundary};
}

/// Boxes of the tests: every kind of boundary in every direction, and layers that 2 and 4 ranks do not
/// divide.
struct NamedBox {
  std::string name;
  Box box;
};
inline void PrintTo(const NamedBox& named, std::ostream* out) {
  *out << named.name;
}

inline std::array<NamedBox, 5> test_boxes() {
  constexpr auto P = Boundary::Periodic, W = Boundary::Wall, S = Boundary::Slip;
  return {NamedBox{"periodic", make_box({16, 12, 24}, {P, P, P})},
          NamedBox{"walls", make_box({16, 12, 24}, {W, W, W})},
          NamedBox{"periodic_slip_wall", make_box({12, 16, 24}, {P, S, W})},
          NamedBox{"wall_periodic_slip_odd_cells", make_box({9, 15, 19}, {W, P, S})},
          NamedBox{"periodic_odd_cells", make_box({15, 11, 27}, {P, P, P})}};
}

/// The symmetries that occur on a box: of the pressure, of the velocity components, and odd at every wall;
/// each once.
inline std::vector<Symmetry> symmetries(const Box& box) {
  constexpr auto O = Parity::Odd;
  std::vector<Symmetry> result;
  for (Symmetry symmetry : {even_symmetry, velocity_symmetry(box, 0), velocity_symmetry(box, 1),
                            velocity_symmetry(box, 2), Symmetry{O, O, O}}) {
    for (int axis = 0; axis < 3; ++axis)
      if (box.boundary[axis] == Boundary::Periodic) symmetry[axis] = Parity::Even;
    if (std::find(result.begin(), result.end(), symmetry) == result.end()) result.push_back(symmetry);
  }
  return result;
}

/// The same numbers on any number of ranks.
inline void fill_random(Field& f, std::uint64_t seed) {
  const Index3 n = f.grid().cells();
  for_each_cell(f.grid(), [&](int i, int j, int k) {
    Random random(seed + (static_cast<std::uint64_t>(k) * n.j + j) * n.i + i);
    owned(f)(i, j, k) = random.uniform(-1, 1);
  });
}

/// One factor of a trigonometric mode along `axis` at cell `m`, also beyond the box (even) or sine (odd) with
/// nodes at the faces across walls.
inline double mode(const Box& box, const Symmetry& symmetry, int axis, int number, int m) {
  const int n = box.cells[axis];
  const double angle = std::numbers::pi * (m + 0.5) / n;
  if (box.boundary[axis] == Boundary::Periodic) return std::cos(2 * number * angle + 0.3);
  return symmetry[axis] == Parity::Even ? std::cos(number * angle) : std::sin(number * angle);
}

/// Phase advance of that mode over one cell.
inline double mode_theta(const Box& box, int axis, int number) {
  const double angle = std::numbers::pi * number / box.cells[axis];
  return box.boundary[axis] == Boundary::Periodic ? 2 * angle : angle;
}

inline double mode(const Box& box, const Symmetry& symmetry, const Index3& number, int i, int j, int k) {
  return mode(box, symmetry, 0, number.i, i) * mode(box, symmetry, 1, number.j, j) *
         mode(box, symmetry, 2, number.k, k);
}

inline void fill_mode(Field& f, const Index3& number) {
  for_each_cell(f.grid(), [&](int i, int j, int k) {
    owned(f)(i, j, k) = mode(f.grid().box(), f.symmetry(), number, i, j, k);
  });
}

inline double largest_difference(const Field& a, const Field& b) {
  Field difference = a;
  for (std::size_t m = 0; m < a.values().size(); ++m) difference.values()[m] -= b.values()[m];
  return max_abs(difference);
}

}  // namespace spume::grid
