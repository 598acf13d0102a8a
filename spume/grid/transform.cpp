#include "spume/grid/transform.hpp"

#include <fftw3-mpi.h>

#include <algorithm>
#include <numbers>

#include "spume/base/contract.hpp"

namespace spume::grid {

namespace {

constexpr unsigned effort = FFTW_ESTIMATE;

struct Kinds {
  fftw_r2r_kind forward, backward;
};

Kinds real_kinds(Boundary boundary, Parity parity) {
  if (boundary == Boundary::Periodic) return {FFTW_R2HC, FFTW_HC2R};
  if (parity == Parity::Even) return {FFTW_REDFT10, FFTW_REDFT01};
  return {FFTW_RODFT10, FFTW_RODFT01};
}

std::vector<double> phase_advance(Boundary boundary, Parity parity, int n, int n_modes) {
  std::vector<double> theta(n_modes);
  for (int m = 0; m < n_modes; ++m) {
    if (boundary == Boundary::Periodic)
      theta[m] = 2 * std::numbers::pi * std::min(m, n - m) / n;
    else
      theta[m] = std::numbers::pi * (parity == Parity::Even ? m : m + 1) / n;
  }
  return theta;
}

/// Rows start on 32 bytes, for vector instructions, and an odd number of 32 bytes apart, so that steps along
/// y or z do not fall into a few sets of the cache.
std::ptrdiff_t padded_row(std::ptrdiff_t n_doubles) {
  return 4 * ((n_doubles + 3) / 4 | 1);
}

fftw_complex* as_complex(double* values) {
  return reinterpret_cast<fftw_complex*>(values);
}

}  // namespace

void Transform::Pass::execute(fftw_plan plan, double* plane) const {
  if (is_complex)
    fftw_execute_dft(plan, as_complex(plane), as_complex(plane));
  else
    fftw_execute_r2r(plan, plane, plane);
}

Transform::Transform(const Grid& grid, const Symmetry& symmetry, Exchange exchange)
    : n_(grid.cells()),
      z_begin_(grid.z_begin()),
      n_layers_(grid.z_end() - grid.z_begin()),
      complex_x_(grid.box().boundary[0] == Boundary::Periodic),
      n_planes_(n_.j),
      layer_(n_.k, nullptr) {
  const auto& boundary = grid.box().boundary;
  for (int axis = 0; axis < 3; ++axis) {
    const int n_modes = axis == 0 && complex_x_ ? n_.i / 2 + 1 : n_[axis];
    theta_[axis] = phase_advance(boundary[axis], symmetry[axis], n_[axis], n_modes);
    normalisation_ /= (boundary[axis] == Boundary::Periodic ? 1.0 : 2.0) * n_[axis];
  }
  row_length_ = padded_row(static_cast<std::ptrdiff_t>(theta_[0].size()) * (complex_x_ ? 2 : 1));
  make_buffers(grid, exchange);
  const Buffer any = allocate(std::max(n_.j, n_.k) * row_length_);
  plan_x(boundary[0], symmetry[0], any.get());
  along_y_ = plan_plane(n_.j, boundary[1], symmetry[1], any.get());
  along_z_ = plan_plane(n_.k, boundary[2], symmetry[2], any.get());
}

Transform::Buffer Transform::allocate(std::ptrdiff_t n) {
  Buffer buffer(fftw_alloc_real(static_cast<std::size_t>(n)));
  std::fill_n(buffer.get(), n, 0.0);
  return buffer;
}

void Transform::make_buffers(const Grid& grid, Exchange exchange) {
  const parallel::Communicator& ranks = grid.communicator();
  const std::ptrdiff_t layer_size = n_.j * row_length_;
  row_ = allocate(n_.i);
  if (ranks.size() > 1 && exchange == Exchange::SharedMemory)
    shared_ = parallel::SharedMemory::among(ranks, static_cast<std::size_t>(n_layers_ * layer_size));
  if (ranks.size() > 1 && !shared_) {
    make_message_buffer(ranks.handle());
  } else {
    plane_ = allocate(n_.k * row_length_);
    const std::vector<int> share = ranks.shares(n_.j);
    y_begin_ = share[ranks.rank()];
    n_planes_ = share[ranks.rank() + 1] - y_begin_;
  }
  if (ranks.size() == 1) buffer_ = allocate(n_layers_ * layer_size);

  std::vector<int> n_before(ranks.size(), 0);  // layers of a rank
  for (int k = 0; k < n_.k; ++k) {
    const int owner = grid.owner_of_layer(k);
    double* const part = shared_ ? shared_->part(owner) : buffer_.get();
    if (shared_ || owner == ranks.rank()) layer_[k] = part + n_before[owner]++ * layer_size;
  }
}

/// Buffer and plans for planes that come and go by messages.
void Transform::make_message_buffer(MPI_Comm comm) {
  const std::array<std::ptrdiff_t, 2> n{n_.k, n_.j};
  const auto block = FFTW_MPI_DEFAULT_BLOCK;
  std::ptrdiff_t n_layers = 0, z_begin = 0, n_planes = 0, y_begin = 0;
  const std::ptrdiff_t size = fftw_mpi_local_size_many_transposed(
      2, n.data(), row_length_, block, block, comm, &n_layers, &z_begin, &n_planes, &y_begin);
  expects(n_layers == n_layers_, "the slabs of a grid are those of FFTW");
  n_planes_ = static_cast<int>(n_planes);
  y_begin_ = static_cast<int>(y_begin);
  buffer_ = allocate(size);
  double* data = buffer_.get();
  to_planes_.reset(
      fftw_mpi_plan_many_transpose(n[0], n[1], row_length_, block, block, data, data, comm, effort));
  to_layers_.reset(
      fftw_mpi_plan_many_transpose(n[1], n[0], row_length_, block, block, data, data, comm, effort));
  expects(to_planes_ && to_layers_, "FFTW transposes every size");
}

void Transform::plan_x(Boundary boundary, Parity parity, double* modes) {
  if (complex_x_) {
    forward_x_.reset(fftw_plan_dft_r2c_1d(n_.i, row_.get(), as_complex(modes), effort));
    backward_x_.reset(fftw_plan_dft_c2r_1d(n_.i, as_complex(modes), row_.get(), effort));
  } else {
    const Kinds kinds = real_kinds(boundary, parity);
    forward_x_.reset(fftw_plan_r2r_1d(n_.i, row_.get(), modes, kinds.forward, effort));
    backward_x_.reset(fftw_plan_r2r_1d(n_.i, modes, row_.get(), kinds.backward, effort | FFTW_DESTROY_INPUT));
  }
  expects(forward_x_ && backward_x_, "FFTW transforms rows of every length");
}

Transform::Pass Transform::plan_plane(int n, Boundary boundary, Parity parity, double* plane) const {
  Pass pass;
  pass.is_complex = complex_x_ && boundary == Boundary::Periodic;
  const int n_modes = static_cast<int>(theta_[0].size());
  if (pass.is_complex) {
    const auto plan = [&](int sign) {
      const int stride = static_cast<int>(row_length_ / 2);
      return fftw_plan_many_dft(1, &n, n_modes, as_complex(plane), nullptr, stride, 1, as_complex(plane),
                                nullptr, stride, 1, sign, effort);
    };
    pass.forward_plan.reset(plan(FFTW_FORWARD));
    pass.backward_plan.reset(plan(FFTW_BACKWARD));
  } else {
    const Kinds kinds = real_kinds(boundary, parity);
    const auto plan = [&](fftw_r2r_kind kind) {
      const int stride = static_cast<int>(row_length_);
      return fftw_plan_many_r2r(1, &n, complex_x_ ? 2 * n_modes : n_modes, plane, nullptr, stride, 1, plane,
                                nullptr, stride, 1, &kind, effort);
    };
    pass.forward_plan.reset(plan(kinds.forward));
    pass.backward_plan.reset(plan(kinds.backward));
  }
  expects(pass.forward_plan && pass.backward_plan, "FFTW transforms planes of every size");
  return pass;
}

void Transform::forward_along_x_and_y(const Field& in) {
  const double* source = in.values().data();
  for (int k = 0; k < n_layers_; ++k) {
    double* modes = layer_[z_begin_ + k];
    for (int j = 0; j < n_.j; ++j, modes += row_length_, source += n_.i) {
      std::copy_n(source, n_.i, row_.get());
      if (complex_x_)
        fftw_execute_dft_r2c(forward_x_.get(), row_.get(), as_complex(modes));
      else
        fftw_execute_r2r(forward_x_.get(), row_.get(), modes);
    }
    along_y_.forward(layer_[z_begin_ + k]);
  }
}

void Transform::backward_along_x_and_y(Field& out) {
  double* target = out.values().data();
  for (int k = 0; k < n_layers_; ++k) {
    double* modes = layer_[z_begin_ + k];
    along_y_.backward(modes);
    for (int j = 0; j < n_.j; ++j, modes += row_length_, target += n_.i) {
      if (complex_x_)
        fftw_execute_dft_c2r(backward_x_.get(), as_complex(modes), row_.get());
      else
        fftw_execute_r2r(backward_x_.get(), modes, row_.get());
      std::copy_n(row_.get(), n_.i, target);
    }
  }
}

/// Brings the modes of all ranks from layers to planes, or back.
void Transform::exchange(const Plan& transpose) const {
  if (shared_) shared_->synchronise();
  if (transpose) fftw_execute(transpose.get());
}

double* Transform::open_plane(int plane) {
  if (to_planes_) return buffer_.get() + plane * n_.k * row_length_;
  for (int k = 0; k < n_.k; ++k)
    std::copy_n(layer_[k] + (y_begin_ + plane) * row_length_, row_length_, plane_.get() + k * row_length_);
  return plane_.get();
}

void Transform::close_plane(int plane) {
  if (to_planes_) return;
  for (int k = 0; k < n_.k; ++k)
    std::copy_n(plane_.get() + k * row_length_, row_length_, layer_[k] + (y_begin_ + plane) * row_length_);
}

void Transform::multiply(double* modes, const double* factor) const {
  const int n_modes = static_cast<int>(theta_[0].size());
  if (complex_x_) {
    for (int m = 0; m < n_modes; ++m) {
      modes[2 * m] *= factor[m];
      modes[2 * m + 1] *= factor[m];
    }
  } else {
    for (int m = 0; m < n_modes; ++m) modes[m] *= factor[m];
  }
}

}  // namespace spume::grid
