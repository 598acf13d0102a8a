#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include "spume/base/index3.hpp"
#include "spume/base/vec3.hpp"
#include "spume/grid/box.hpp"

namespace spume::interface {

/// A block of cells of the grid: begin ≤ (i, j, k) < end. Arrays over it have i fastest, then j, k. Along a
/// periodic direction a block may reach over the edge of the grid, but never meets itself.
struct CellBox {
  Index3 begin, end;

  bool empty() const { return begin.i >= end.i || begin.j >= end.j || begin.k >= end.k; }
  bool contains(int i, int j, int k) const {
    return i >= begin.i && i < end.i && j >= begin.j && j < end.j && k >= begin.k && k < end.k;
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

/// The cells of the grid, and the directions in which they repeat.
struct Lattice {
  Index3 cells;
  std::array<bool, 3> periodic{false, false, false};

  /// The image of coordinate c in begin … begin + n − 1; c itself in other directions.
  int image(int c, int begin, int axis) const {
    if (!periodic[axis]) return c;
    const int n = cells[axis], step = c - begin;
    if (step >= 0 && step < n) return c;  // nearly always, without the division
    const int r = step % n;
    return begin + (r < 0 ? r + n : r);
  }
  /// The image of a cell that is in the block, if any is.
  Index3 image_in(const CellBox& box, int i, int j, int k) const {
    return {image(i, box.begin.i, 0), image(j, box.begin.j, 1), image(k, box.begin.k, 2)};
  }
  /// The block with `layers` more cells on every side: as far as the grid goes, or, along a periodic
  /// direction, until it takes up all of it.
  CellBox grown(const CellBox& box, int layers) const {
    CellBox g = box;
    for (int d = 0; d < 3; ++d) {
      g.begin[d] -= layers;
      g.end[d] += layers;
      const bool all = periodic[d] && g.end[d] - g.begin[d] >= cells[d];
      if (all || !periodic[d]) {
        g.begin[d] = all ? 0 : std::max(0, g.begin[d]);
        g.end[d] = all ? cells[d] : std::min(cells[d], g.end[d]);
      }
    }
    return g;
  }
};

inline Lattice lattice_of(const grid::Box& box) {
  return {box.cells, box.domain().periodic};
}

/// Calls body(i, j, k) for every cell of a box, i fastest.
template <class Body>
void for_each_cell(const CellBox& box, Body&& body) {
  for (int k = box.begin.k; k < box.end.k; ++k)
    for (int j = box.begin.j; j < box.end.j; ++j)
      for (int i = box.begin.i; i < box.end.i; ++i) body(i, j, k);
}

/// Calls body(n, cell) for the cells of a block in order: n counts them, `cell` is the place in the whole
/// grid of the image that lies there.
template <class Body>
void for_each_cell_of_grid(const CellBox& box, const Lattice& lattice, Body&& body) {
  const CellBox whole = all_cells(lattice.cells);
  const int row_length = box.end.i - box.begin.i, first = lattice.image(box.begin.i, 0, 0),
            until_edge = std::min(row_length, lattice.cells.i - first);
  std::size_t n = 0;
  for (int k = box.begin.k; k < box.end.k; ++k)
    for (int j = box.begin.j; j < box.end.j; ++j, n += row_length) {
      const std::size_t row = whole.offset(0, lattice.image(j, 0, 1), lattice.image(k, 0, 2));
      for (int m = 0; m < until_edge; ++m) body(n + m, row + first + m);
      for (int m = until_edge; m < row_length; ++m) body(n + m, row + m - until_edge);
    }
}

}  // namespace spume::interface
