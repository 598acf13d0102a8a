#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "spume/grid/field.hpp"

namespace spume::flow {

/// Layers of ghosts around the owned cells: the predictor traces the cells next to the owned ones, whose
/// fourth-order slopes and pressure gradients reach two cells further.
inline constexpr int margin = 3;

using GhostedField = grid::Ghosted<margin>;
using GhostedVector = std::array<GhostedField, 3>;
inline GhostedVector ghosted_vector(const grid::VectorField& v) {
  return {GhostedField(v[0]), GhostedField(v[1]), GhostedField(v[2])};
}

/// A box of cells in the numbering of one rank: its first owned cell is (0, 0, 0). Upper ends are exclusive.
struct CellRange {
  Index3 lower, upper;

  CellRange grown(int axis, int below, int above) const {
    CellRange range = *this;
    range.lower[axis] -= below;
    range.upper[axis] += above;
    return range;
  }
  CellRange grown(int layers) const {
    return grown(0, layers, layers).grown(1, layers, layers).grown(2, layers, layers);
  }
};

/// How the owned cells of a rank and their ghosts lie in memory: as in Ghosted<margin>, so that one offset
/// addresses the same cell of every array.
class BlockLayout {
 public:
  explicit BlockLayout(const grid::Grid& grid);

  CellRange owned() const { return {{0, 0, 0}, cells_}; }
  /// Faces across `axis` are numbered by the cell above them: the owned cells have faces 0 … n along the
  /// axis.
  CellRange owned_faces(int axis) const { return owned().grown(axis, 0, 1); }
  std::ptrdiff_t stride(int axis) const { return stride_[axis]; }
  std::ptrdiff_t offset(int i, int j, int k) const { return k * stride_[2] + j * stride_[1] + i; }
  /// Place in the values of a Field of the owned cell with this offset.
  std::ptrdiff_t place(std::ptrdiff_t offset) const {
    const std::ptrdiff_t k = offset / stride_[2], j = offset % stride_[2] / stride_[1];
    return (k * cells_.j + j) * cells_.i + offset % stride_[1];
  }
  std::size_t size() const { return size_; }
  /// Place of cell (0, 0, 0) in an array of size().
  std::ptrdiff_t origin() const { return offset(margin, margin, margin); }

 private:
  Index3 cells_;
  std::array<std::ptrdiff_t, 3> stride_;
  std::size_t size_;
};

/// One work value for every cell, or every face across one axis, of a block.
class BlockArray {
 public:
  explicit BlockArray(const BlockLayout& layout) : values_(layout.size(), 0.0), origin_(layout.origin()) {}
  double* first() { return values_.data() + origin_; }
  const double* first() const { return values_.data() + origin_; }

 private:
  std::vector<double> values_;
  std::ptrdiff_t origin_;
};
using BlockVector = std::array<BlockArray, 3>;
inline BlockVector block_vector(const BlockLayout& layout) {
  return {BlockArray(layout), BlockArray(layout), BlockArray(layout)};
}

/// Pointer to the value of the first owned cell.
inline const double* first(const GhostedField& f, const grid::Grid& grid) {
  return f.at(0, 0, grid.z_begin());
}

/// Calls body(offset, count) for every row along x of `range`: its cells are offset … offset + count − 1.
template <class Body>
void for_each_row(const BlockLayout& layout, const CellRange& range, Body&& body) {
  for (int k = range.lower.k; k < range.upper.k; ++k)
    for (int j = range.lower.j; j < range.upper.j; ++j)
      body(layout.offset(range.lower.i, j, k), range.upper.i - range.lower.i);
}

/// The same with the place of the row in the values of a Field: body(offset, place, count). Rows of owned
/// cells, whole.
template <class Body>
void for_each_owned_row(const BlockLayout& layout, const CellRange& range, Body&& body) {
  const Index3 n = layout.owned().upper;
  for (int k = range.lower.k; k < range.upper.k; ++k)
    for (int j = range.lower.j; j < range.upper.j; ++j)
      body(layout.offset(0, j, k), (static_cast<std::ptrdiff_t>(k) * n.j + j) * n.i, n.i);
}

}  // namespace spume::flow
