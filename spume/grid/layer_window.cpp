#include "spume/grid/layer_window.hpp"

#include <algorithm>

#include "spume/base/contract.hpp"

namespace spume::grid {

LayerRing::LayerRing(const Grid& grid, int reach)
    : n_(grid.cells()),
      reach_(reach),
      n_kept_(2 * reach + 2),
      stride_y_(n_.i + 2 * reach),
      stride_z_(stride_y_ * (n_.j + 2 * reach)),
      values_(static_cast<std::size_t>(n_kept_ * stride_z_), 0.0) {}

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
  const int w = reach_;
  for (int j = 0; j < n_.j; ++j) {
    double* places = row(j, k) - w;
    for (int g = 0; g < w; ++g) {
      places[w - 1 - g] = x_.sign * places[x_.below(g, w, n_.i)];
      places[w + n_.i + g] = x_.sign_above(g) * places[x_.above(g, w, n_.i)];
    }
  }
  double* rows = layer(k);
  const auto copy_row = [&](int from, double sign, int to) {
    const double* cells = rows + from * stride_y_;
    double* ghosts = rows + to * stride_y_;
    for (std::ptrdiff_t m = 0; m < stride_y_; ++m) ghosts[m] = sign * cells[m];
  };
  for (int g = 0; g < w; ++g) {
    copy_row(y_.below(g, w, n_.j), y_.sign, w - 1 - g);
    copy_row(y_.above(g, w, n_.j), y_.sign_above(g), w + n_.j + g);
  }
}

LayerWindow::LayerWindow(const Grid& grid, int reach, int beyond)
    : reach_(reach),
      beyond_(beyond),
      begin_(grid.z_begin()),
      end_(grid.z_end()),
      walls_(grid),
      layer_size_(static_cast<std::ptrdiff_t>(grid.cells().i) * grid.cells().j),
      below_(static_cast<std::size_t>((reach + beyond) * layer_size_)),
      above_(below_.size()),
      ring_(grid, reach) {
  expects((reach == 1 || reach == 2) && (beyond == 0 || beyond == 1),
          "a window looks one or two cells to either side, and stands at most one layer outside");
}

void LayerWindow::open(const Field& f, int face_axis) {
  owned_ = f.values().data();
  for (int axis = 0; axis < 3; ++axis) continuation_[axis] = Continuation(f, axis, axis == face_axis);
  ring_.continue_by(continuation_[0], continuation_[1]);
  exchange_layers(f, reach_ + beyond_, below_.data(), above_.data());
  next_ = first() - reach_;
}

void LayerWindow::move_to(int k) {
  for (; next_ <= k + reach_; ++next_) load(next_);
}

void LayerWindow::load(int k) {
  const int n = end_ - begin_, depth = reach_ + beyond_;
  const Continuation& z = continuation_[2];
  if (k < begin_ && walls_.below)
    ring_.take(k, z.sign, owned_ + z.below(begin_ - 1 - k, 0, n) * layer_size_);
  else if (k < begin_)
    ring_.take(k, 1, below_.data() + (k - begin_ + depth) * layer_size_);
  else if (k < end_)
    ring_.take(k, 1, owned_ + (k - begin_) * layer_size_);
  else if (walls_.above)
    ring_.take_image(k, z.sign_above(k - end_), begin_ + z.above(k - end_, 0, n));
  else
    ring_.take(k, 1, above_.data() + (k - end_) * layer_size_);
}

}  // namespace spume::grid
