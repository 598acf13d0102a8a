#pragma once

namespace spume {

/// Index of a grid cell, or a number of cells, along x, y, z.
struct Index3 {
  int i = 0, j = 0, k = 0;

  constexpr int& operator[](int axis) { return axis == 0 ? i : axis == 1 ? j : k; }
  constexpr int operator[](int axis) const { return axis == 0 ? i : axis == 1 ? j : k; }
  constexpr bool operator==(const Index3&) const = default;
};

}  // namespace spume
