#pragma once

#include "spume/grid/grid.hpp"

namespace spume::grid {

/// Calls body(i, j, k) for every owned cell, i fastest.
template <class Body>
void for_each_cell(const Grid& grid, Body&& body) {
  const Index3 n = grid.cells();
  for (int k = grid.z_begin(); k < grid.z_end(); ++k)
    for (int j = 0; j < n.j; ++j)
      for (int i = 0; i < n.i; ++i) body(i, j, k);
}

}  // namespace spume::grid
