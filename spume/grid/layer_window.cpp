#include "spume/grid/layer_window.hpp"

#include <algorithm>

#include "spume/base/contract.hpp"

namespace spume::grid {

LayerRing::LayerRing(const Grid& grid)
    : n_(grid.cells()),
      stride_y_(n_.i + 2),
      stride_z_(stride_y_ * (n_.j + 2)),
      values_(static_cast<std::size_t>(n_kept * stride_z_), 0.0) {}

void LayerRing::continue_by(const Continuation& x, const Continuation& y) {
  x_ = x;
  y_ = y;
}

void LayerRing::take(int k, double sign, const double* cells) {
  for (int j = 0; j < n_.j; ++j, cells += n_.i) {
    double* to = row(j, k);
    for (int i = 0; i < n_.i; ++i) to[i] = sign * cells[i];
  }
  fill_ghosts(k);
}

void LayerRing::take_image(int k, double sign, int of) {
  const double* from = layer(of);
  double* to = layer(k);
  for (std::ptrdiff_t m = 0; m < stride_z_; ++m) to[m] = sign * from[m];
}

void LayerRing::fill_ghosts(int k) {
  for (int j = 0; j < n_.j; ++j) {
    double* cells = row(j, k);
    cells[-1] = x_.sign_below * cells[x_.below(0, 0, n_.i)];
    cells[n_.i] = x_.sign_above * cells[x_.above(0, 0, n_.i)];
  }
  const auto copy_row = [&](int from, double sign, int to) {
    const double* cells = row(from, k) - 1;
    double* ghosts = row(to, k) - 1;
    for (std::ptrdiff_t m = 0; m < stride_y_; ++m) ghosts[m] = sign * cells[m];
  };
  copy_row(y_.below(0, 0, n_.j), y_.sign_below, -1);
  copy_row(y_.above(0, 0, n_.j), y_.sign_above, n_.j);
}

LayerWindow::LayerWindow(const Grid& grid, int depth)
    : depth_(depth),
      begin_(grid.z_begin()),
      end_(grid.z_end()),
      walls_(grid),
      layer_size_(static_cast<std::ptrdiff_t>(grid.cells().i) * grid.cells().j),
      below_(static_cast<std::size_t>(depth * layer_size_)),
      above_(below_.size()),
      ring_(grid) {
  expects(depth == 1 || depth == 2, "a window looks one or two layers beyond the owned ones");
}

void LayerWindow::open(const Field& f, int face_axis) {
  owned_ = f.values().data();
  for (int axis = 0; axis < 3; ++axis) continuation_[axis] = Continuation(f, axis, axis == face_axis);
  ring_.continue_by(continuation_[0], continuation_[1]);
  exchange_layers(f, depth_, below_.data(), above_.data());
  next_ = first() - 1;
}

void LayerWindow::move_to(int k) {
  for (; next_ <= k + 1; ++next_) load(next_);
}

void LayerWindow::load(int k) {
  if (k < begin_ && walls_.below)
    ring_.take(k, continuation_[2].sign_below, owned_);
  else if (k < begin_)
    ring_.take(k, 1, below_.data() + (k - begin_ + depth_) * layer_size_);
  else if (k < end_)
    ring_.take(k, 1, owned_ + (k - begin_) * layer_size_);
  else if (walls_.above)
    ring_.take_image(k, continuation_[2].sign_above, end_ - 1);
  else
    ring_.take(k, 1, above_.data() + (k - end_) * layer_size_);
}

}  // namespace spume::grid
