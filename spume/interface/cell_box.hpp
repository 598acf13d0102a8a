#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "spume/base/index3.hpp"
#include "spume/base/vec3.hpp"
#include "spume/grid/box.hpp"

namespace spume::interface {

/// A block of cells of the grid: begin ≤ (i, j, k) < end. Arrays over it have i fastest, then j, k.
struct CellBox {
  Index3 begin, end;

  bool empty() const { return begin.i >= end.i || begin.j >= end.j || begin.k >= end.k; }
  bool contains(int i, int j, int k) const {
    return i >= begin.i && i < end.i && j >= begin.j && j < end.j && k >= begin.k && k < end.k;
  }
  bool overlaps(const CellBox& b) const {
    for (int d = 0; d < 3; ++d)
      if (begin[d] >= b.end[d] || b.begin[d] >= end[d]) return false;
    return true;
  }
  std::size_t size() const {
    if (empty()) return 0;
    return static_cast<std::size_t>(end.i - begin.i) * (end.j - begin.j) * (end.k - begin.k);
  }
  std::ptrdiff_t stride_y() const { return end.i - begin.i; }
  std::ptrdiff_t stride_z() const { return stride_y() * (end.j - begin.j); }
  std::size_t offset(int i, int j, int k) const {
    return static_cast<std::size_t>((k - begin.k) * stride_z() + (j - begin.j) * stride_y() + (i - begin.i));
  }
  /// Takes in the cell (i, j, k).
  void include(int i, int j, int k) {
    begin = {std::min(begin.i, i), std::min(begin.j, j), std::min(begin.k, k)};
    end = {std::max(end.i, i + 1), std::max(end.j, j + 1), std::max(end.k, k + 1)};
  }
};

/// A box without cells that include() can start from.
inline CellBox no_cells() {
  constexpr int far = 1 << 30;
  return {{far, far, far}, {-far, -far, -far}};
}

inline CellBox all_cells(const Index3& cells) {
  return {{0, 0, 0}, cells};
}

/// The box with `layers` more cells on every side, as far as the grid goes.
inline CellBox grown(const CellBox& box, int layers, const Index3& cells) {
  CellBox g = box;
  for (int d = 0; d < 3; ++d) {
    g.begin[d] = std::max(0, box.begin[d] - layers);
    g.end[d] = std::min(cells[d], box.end[d] + layers);
  }
  return g;
}

/// Calls body(i, j, k) for every cell of a box, i fastest.
template <class Body>
void for_each_cell(const CellBox& box, Body&& body) {
  for (int k = box.begin.k; k < box.end.k; ++k)
    for (int j = box.begin.j; j < box.end.j; ++j)
      for (int i = box.begin.i; i < box.end.i; ++i) body(i, j, k);
}

}  // namespace spume::interface
