#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "spume/grid/continuation.hpp"
#include "spume/grid/field.hpp"

namespace spume::grid {

/// A few consecutive layers of cells with one ghost around each in x and y. A new layer takes the place of
/// the one four below it.
class LayerRing {
 public:
  explicit LayerRing(const Grid& grid);

  /// How the layers to come go on across x and y.
  void continue_by(const Continuation& x, const Continuation& y);
  /// The value of cell (0, j, k); its neighbours in x are beside it, cells −1 and n_x included.
  double* row(int j, int k) { return layer(k) + (j + 1) * stride_y_ + 1; }
  const double* row(int j, int k) const { return layer(k) + (j + 1) * stride_y_ + 1; }
  std::ptrdiff_t stride_y() const { return stride_y_; }
  /// Layer k ← sign × cells, n_x n_y of them.
  void take(int k, double sign, const double* cells);
  /// Layer k ← sign × layer `of`.
  void take_image(int k, double sign, int of);
  /// Fills the ghosts of layer k from its cells.
  void fill_ghosts(int k);

 private:
  static constexpr int n_kept = 4;
  std::ptrdiff_t place(int k) const { return ((k + n_kept) % n_kept) * stride_z_; }  // from k = −4 on
  double* layer(int k) { return values_.data() + place(k); }
  const double* layer(int k) const { return values_.data() + place(k); }

  Index3 n_;
  std::ptrdiff_t stride_y_, stride_z_;
  std::vector<double> values_;
  Continuation x_, y_;
};

/// A field seen through a window of three layers, each with its ghosts, that moves up layer by layer. It
/// stays in the cache, where Ghosted is a copy of the whole field, which costs more than a short stencil
/// itself.
class LayerWindow {
 public:
  /// With `depth` 2 the window also stands on the layers next to the owned ones, unless a wall is between.
  explicit LayerWindow(const Grid& grid, int depth = 1);

  /// Puts the window before its first layer. `face_axis`: the axis whose lower faces the values lie on; −1
  /// for values at centres. Collective.
  void open(const Field& f, int face_axis = -1);
  void open(const Field&&, int = -1) = delete;
  /// The layers on which it can stand.
  int first() const { return begin_ - (walls_.below ? 0 : depth_ - 1); }
  int last() const { return end_ - 1 + (walls_.above ? 0 : depth_ - 1); }
  /// Moves on to the next layer k; layers k − 1, k and k + 1 can be seen. The field may be overwritten up to
  /// layer k now.
  void move_to(int k);
  const double* row(int j, int k) const { return ring_.row(j, k); }
  std::ptrdiff_t stride_y() const { return ring_.stride_y(); }
  /// How the field goes on across its boundaries.
  const std::array<Continuation, 3>& continuation() const { return continuation_; }
  const WallsAlongZ& walls() const { return walls_; }

 private:
  void load(int k);

  int depth_, begin_, end_;        ///< owned layers
  int next_ = 0;                   ///< layer to be loaded
  const double* owned_ = nullptr;  ///< values of the field
  WallsAlongZ walls_;
  std::ptrdiff_t layer_size_;
  std::vector<double> below_, above_;  ///< layers of other ranks, or of the other end of a periodic box
  std::array<Continuation, 3> continuation_;
  LayerRing ring_;
};

}  // namespace spume::grid
