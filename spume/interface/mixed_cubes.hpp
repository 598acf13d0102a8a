#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <vector>

#include "spume/interface/cell_box.hpp"
#include "spume/mesh/film_mesh.hpp"

namespace spume::interface {

/// The phases that win at the corners of a cube between cell centres: corner c is a step along axis d away
/// from the lowest one where bit d of c is set.
using CubeWinners = std::array<mesh::Phase, 8>;

/// The cubes between cell centres whose corners are not all of one phase, known by their lowest corners.
class MixedCubes {
 public:
  /// `winner` at every cell; must outlive it.
  MixedCubes(const Lattice& lattice, const std::vector<mesh::Phase>& winner)
      : lattice_(lattice), whole_(all_cells(lattice.cells)), winner_(winner), end_(lattice.cells) {
    for (int d = 0; d < 3; ++d)
      if (!lattice.periodic[d]) --end_[d];
  }

  /// One past the last cube along each axis.
  const Index3& end() const { return end_; }

  /// Calls body(cube) for the mixed cubes of layer k, row by row.
  template <class Body>
  void for_each_in_layer(int k, Body&& body) {
    for (int j = 0; j < end_.j; ++j) {
      find_mixed(j, k);
      for (int i = 0; i < end_.i; ++i)
        if (mixed_[i]) body(Index3{i, j, k});
    }
  }

  /// Offsets of shares of the layers with about as many films each.
  std::vector<int> shares_of_layers(int n_shares) {
    std::vector<long> up_to{0};
    for (int k = 0; k < end_.k; ++k) {
      long n_mixed = 0;
      for (int j = 0; j < end_.j; ++j) {
        find_mixed(j, k);
        n_mixed += std::count_if(mixed_.begin(), mixed_.end(), [](int mixed) { return mixed != 0; });
      }
      up_to.push_back(up_to.back() + n_mixed);
    }
    std::vector<int> offset;
    for (int n = 0; n <= n_shares; ++n)
      offset.push_back(static_cast<int>(
          std::lower_bound(up_to.begin(), up_to.end(), up_to.back() * n / n_shares) - up_to.begin()));
    offset.back() = end_.k;
    return offset;
  }

  CubeWinners winners_of(const Index3& cube) const {
    CubeWinners w;
    for (int c = 0; c < 8; ++c) w[c] = winner_[lattice_point(cube, c)];
    return w;
  }
  /// The place of a corner of a cube among all cells.
  std::size_t lattice_point(const Index3& cube, int corner) const {
    return whole_.offset(lattice_.image(cube.i + (corner & 1), 0, 0),
                         lattice_.image(cube.j + (corner >> 1 & 1), 0, 1),
                         lattice_.image(cube.k + (corner >> 2), 0, 2));
  }

 private:
  /// Marks the mixed cubes of a row.
  void find_mixed(int j, int k) {
    const int last = whole_.end.i - 1;  // whose cube, in a periodic row, goes on at the other end
    mixed_.resize(end_.i);
    const Index3 first{0, j, k};
    const mesh::Phase *w = &winner_[lattice_point(first, 0)], *y = &winner_[lattice_point(first, 2)],
                      *z = &winner_[lattice_point(first, 4)], *yz = &winner_[lattice_point(first, 6)];
    const auto is_mixed = [=](int i, int next) {
      return (w[i] ^ w[next]) | (w[i] ^ y[i]) | (w[i] ^ y[next]) | (w[i] ^ z[i]) | (w[i] ^ z[next]) |
             (w[i] ^ yz[i]) | (w[i] ^ yz[next]);
    };
    for (int i = 0; i < last; ++i) mixed_[i] = is_mixed(i, i + 1);
    if (end_.i > last) mixed_[last] = is_mixed(last, 0);
  }

  Lattice lattice_;
  CellBox whole_;
  const std::vector<mesh::Phase>& winner_;
  Index3 end_;
  std::vector<int> mixed_;  ///< of the row: 0 where all corners of a cube have one winner
};

/// Of a mixed cube: whether two phases win at its corners, and no third.
inline bool are_two_phases(const CubeWinners& w) {
  const mesh::Phase other = *std::find_if(w.begin(), w.end(), [&](mesh::Phase p) { return p != w[0]; });
  return std::all_of(w.begin(), w.end(), [&](mesh::Phase p) { return p == w[0] || p == other; });
}

/// Whether a face has its corners alternately in one phase and another. A line that visits a face twice
/// could be filled by a diagonal in that face, on both its sides.
inline bool has_ambiguous_face(const CubeWinners& w) {
  for (int axis = 0; axis < 3; ++axis) {
    const int u = 1 << (axis + 1) % 3, v = 1 << (axis + 2) % 3;
    for (int o : {0, 1 << axis})
      if (w[o] == w[o | u | v] && w[o | u] == w[o | v] && w[o] != w[o | u]) return true;
  }
  return false;
}

}  // namespace spume::interface
