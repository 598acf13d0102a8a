#pragma once

#include <cstddef>
#include <memory>

#include "spume/base/index3.hpp"
#include "spume/base/vec3.hpp"
#include "spume/grid/box.hpp"
#include "spume/parallel/communicator.hpp"

namespace spume::grid {

/// A regular grid of cubic cells, cut into slabs along z, one slab a rank, as FFTW-MPI cuts them (block size
/// ⌈n_z/ranks⌉). Cell (i, j, k) has its centre at lower + (i+½, j+½,
/// k+½) h. Fields keep a reference to their grid, so a grid neither moves nor is copied.
class Grid {
 public:
  /// Collective, as the end of the object is. Throws InputError when a direction has fewer than 4 cells, or
  /// when a slab would be thinner than 4 cells (too many ranks), naming the largest smaller number of ranks
  /// that works.
  Grid(const parallel::Communicator& communicator, const Box& box);
  ~Grid();
  Grid(const Grid&) = delete;
  Grid& operator=(const Grid&) = delete;

  const Box& box() const { return box_; }
  double h() const { return h_; }              ///< cell edge [m]
  Index3 cells() const { return box_.cells; }  ///< of the whole box
  int z_begin() const { return z_begin_; }     ///< first owned layer k
  int z_end() const { return z_end_; }         ///< one past the last owned layer
  int owner_of_layer(int k) const;             ///< rank
  std::size_t owned_size() const { return owned_size_; }
  std::size_t total_size() const { return total_size_; }
  Vec3 centre(int i, int j, int k) const { return box_.lower + h_ * Vec3{i + 0.5, j + 0.5, k + 0.5}; }
  const parallel::Communicator& communicator() const { return communicator_; }

  /// The FFTW side (transforms); only grid/ sees its definition.
  struct Implementation;
  Implementation& implementation() const { return *implementation_; }

 private:
  parallel::Communicator communicator_;
  Box box_;
  double h_;
  int z_begin_, z_end_;
  std::size_t owned_size_, total_size_;
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace spume::grid
