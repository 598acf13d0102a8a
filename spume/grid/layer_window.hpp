#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "spume/grid/continuation.hpp"
#include "spume/grid/field.hpp"

namespace spume::grid {

/// A few consecutive layers of cells with `reach` ghosts around each in x and y. A new layer takes the place
/// of the one 2 reach + 2 below it.
class LayerRing {
 public:
  explicit LayerRing(const Grid& grid, int reach = 1);

  /// How the layers to come go on across x and y.
  void continue_by(const Continuation& x, const Continuation& y);
  /// The value of cell (0, j, k); its neighbours in x are beside it, ghosts included.
  double* row(int j, int k) { return layer(k) + (j + reach_) * stride_y_ + reach_; }
  const double* row(int j, int k) const { return layer(k) + (j + reach_) * stride_y_ + reach_; }
  std::ptrdiff_t stride_y() const { return stride_y_; }
  /// Layer k ← sign × cells, n_x n_y of them.
  void take(int k, double sign, const double* cells);
  /// Layer k ← sign × layer `of`.
  void take_image(int k, double sign, int of);
  /// Fills the ghosts of layer k from its cells.
  void fill_ghosts(int k);

 private:
  std::ptrdiff_t place(int k) const { return ((k + n_kept_) % n_kept_) * stride_z_; }  // from k = −n_kept on
  double* layer(int k) { return values_.data() + place(k); }
  const double* layer(int k) const { return values_.data() + place(k); }

  Index3 n_;
  int reach_, n_kept_;
  std::ptrdiff_t stride_y_, stride_z_;
  std::vector<double> values_;
  Continuation x_, y_;
};

/// A field seen through a window of 2 reach + 1 layers, each with its ghosts, that moves up layer by layer.
/// It stays in the cache, where Ghosted is a copy of the whole field, which costs more than a short stencil
/// itself.
class LayerWindow {
 public:
  /// `reach`: how many cells can be seen on either side. With `beyond` 1 the window also stands on the layers
  /// next to the owned ones, unless a wall is between.
  explicit LayerWindow(const Grid& grid, int reach = 1, int beyond = 0);

  /// Puts the window before its first layer. `face_axis`: the axis whose lower faces the values lie on; −1
  /// for values at centres. Collective.
  void open(const Field& f, int face_axis = -1);
  void open(const Field&&, int = -1) = delete;
  /// The layers on which it can stand.
  int first() const { return begin_ - (walls_.below ? 0 : beyond_); }
  int last() const { return end_ - 1 + (walls_.above ? 0 : beyond_); }
  /// Moves on to the next layer k; layers k − reach to k + reach can be seen. The field may be overwritten up
  /// to layer k now.
  void move_to(int k);
  const double* row(int j, int k) const { return ring_.row(j, k); }
  /// The row `offset` cells further along `axis`.
  const double* row(int j, int k, int axis, int offset) const {
    return axis == 0 ? row(j, k) + offset : axis == 1 ? row(j + offset, k) : row(j, k + offset);
  }
  std::ptrdiff_t stride_y() const { return ring_.stride_y(); }
  /// How the field goes on across its boundaries.
  const std::array<Continuation, 3>& continuation() const { return continuation_; }
  const WallsAlongZ& walls() const { return walls_; }

 private:
  void load(int k);

  int reach_, beyond_;
  int begin_, end_;                ///< owned layers
  int next_ = 0;                   ///< layer to be loaded
  const double* owned_ = nullptr;  ///< values of the field
  WallsAlongZ walls_;
  std::ptrdiff_t layer_size_;
  std::vector<double> below_, above_;  ///< layers of other ranks, or of the other end of a periodic box
  std::array<Continuation, 3> continuation_;
  LayerRing ring_;
};

}  // namespace spume::grid
