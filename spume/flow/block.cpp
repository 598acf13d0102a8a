#include "spume/flow/block.hpp"

namespace spume::flow {

BlockLayout::BlockLayout(const grid::Grid& grid)
    : cells_{grid.cells().i, grid.cells().j, grid.z_end() - grid.z_begin()} {
  stride_[0] = 1;
  stride_[1] = cells_.i + 2 * margin;
  stride_[2] = stride_[1] * (cells_.j + 2 * margin);
  size_ = static_cast<std::size_t>(stride_[2]) * (cells_.k + 2 * margin);
}

}  // namespace spume::flow
