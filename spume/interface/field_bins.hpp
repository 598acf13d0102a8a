#pragma once

#include <algorithm>
#include <array>
#include <vector>

#include "spume/interface/potentials.hpp"

namespace spume::interface {

/// Which fields may be candidates where: those whose cells meet each block of 8³ cells.
class FieldBins {
 public:
  explicit FieldBins(const PhasePotentials& potentials) {
    const Lattice& lattice = potentials.lattice();
    for (int d = 0; d < 3; ++d) n_[d] = (lattice.cells[d] + edge - 1) / edge;
    fields_.resize(static_cast<std::size_t>(n_.i) * n_.j * n_.k);
    for (const auto& field : potentials.fields()) {
      std::array<std::vector<int>, 3> blocks;
      for (int d = 0; d < 3; ++d) blocks[d] = blocks_along(field.cells, lattice, d);
      for (int k : blocks[2])
        for (int j : blocks[1])
          for (int i : blocks[0])
            fields_[(static_cast<std::size_t>(k) * n_.j + j) * n_.i + i].push_back(&field);
    }
  }
  const std::vector<const PhaseField*>& at(int i, int j, int k) const {
    return fields_[(static_cast<std::size_t>(k / edge) * n_.j + j / edge) * n_.i + i / edge];
  }

 private:
  static constexpr int edge = 8;

  static std::vector<int> blocks_along(const CellBox& cells, const Lattice& lattice, int axis) {
    std::vector<int> blocks;
    for (int c = cells.begin[axis]; c < cells.end[axis]; ++c)
      blocks.push_back(lattice.image(c, 0, axis) / edge);
    std::sort(blocks.begin(), blocks.end());
    blocks.erase(std::unique(blocks.begin(), blocks.end()), blocks.end());
    return blocks;
  }

  Index3 n_;
  std::vector<std::vector<const PhaseField*>> fields_;
};

}  // namespace spume::interface
