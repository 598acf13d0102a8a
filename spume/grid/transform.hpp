#pragma once

#include <fftw3.h>

#include <array>
#include <cstddef>
#include <memory>
#include <span>
#include <type_traits>
#include <vector>

#include "spume/grid/field.hpp"
#include "spume/parallel/shared_memory.hpp"

// Internal to grid/: brings FFTW's header.
namespace spume::grid {

/// Trigonometric transforms of cell-centred fields of one symmetry, with their plans and buffers.
/// Periodic directions: discrete Fourier transform; walls: DCT-II (even) and DST-II (odd).
///
/// The transform is a product of one-dimensional FFTW plans: x row by row, y in each layer, then z in each
/// plane of constant y. Ranks of one machine share the memory of the modes, and each takes its planes out of
/// the layers of all; where they cannot, FFTW transposes the slabs by messages, which costs several times as
/// much. Every plan is made with FFTW_ESTIMATE, so runs repeat to the last bit (plans that FFTW measures
/// depend on the load of the machine), and sees the same data on any number of ranks, so results do not
/// depend on that either. Along periodic x the coefficients are complex, interleaved; y and z then use
/// complex transforms where periodic. After a real transform along x, periodic y and z use FFTW's
/// half-complex order.
class Transform {
 public:
  enum class Exchange { SharedMemory, Messages };

  /// Collective, as the end of the object is. `symmetry` is Even in periodic directions. Messages are used
  /// also where memory cannot be shared.
  Transform(const Grid& grid, const Symmetry& symmetry, Exchange exchange = Exchange::SharedMemory);

  /// Phase advance θ ∈ [0, π] over one cell of each mode along `axis`; along x the modes of one row.
  std::span<const double> theta(int axis) const { return theta_[axis]; }
  /// One over the product of a forward and a backward transform.
  double normalisation() const { return normalisation_; }
  /// Rows of modes along x that this rank holds.
  int n_rows() const { return n_planes_ * n_.k; }
  int mode_y(int row) const { return y_begin_ + row / n_.k; }
  int mode_z(int row) const { return row % n_.k; }

  /// out = backward(factor · forward(in)) without normalisation; `in` and `out` may be the same field.
  /// `factor_of_row(row)` gives a pointer to the factors of the modes of a row, theta(0).size() of them,
  /// valid until the next call; it is called for the rows in order. Collective.
  template <class FactorOfRow>
  void filter(const Field& in, Field& out, FactorOfRow&& factor_of_row) {
    forward_along_x_and_y(in);
    exchange(to_planes_);
    for (int plane = 0; plane < n_planes_; ++plane) {
      double* modes = open_plane(plane);
      along_z_.forward(modes);
      for (int z = 0; z < n_.k; ++z) multiply(modes + z * row_length_, factor_of_row(plane * n_.k + z));
      along_z_.backward(modes);
      close_plane(plane);
    }
    exchange(to_layers_);
    backward_along_x_and_y(out);
  }

 private:
  struct PlanDeleter {
    void operator()(fftw_plan plan) const { fftw_destroy_plan(plan); }
  };
  using Plan = std::unique_ptr<std::remove_pointer_t<fftw_plan>, PlanDeleter>;
  struct BufferDeleter {
    void operator()(double* buffer) const { fftw_free(buffer); }
  };
  using Buffer = std::unique_ptr<double[], BufferDeleter>;

  /// Transforms along one direction; y and z in place in a plane of rows, x between a row of values and one
  /// of modes.
  struct Pass {
    Plan forward_plan, backward_plan;
    bool is_complex = false;  ///< complex to complex, otherwise real to real

    void forward(double* plane) const { execute(forward_plan.get(), plane); }
    void backward(double* plane) const { execute(backward_plan.get(), plane); }
    void execute(fftw_plan plan, double* plane) const;
  };

  static Buffer allocate(std::ptrdiff_t n);
  void make_buffers(const Grid& grid, Exchange exchange);
  void make_message_buffer(MPI_Comm comm);
  void plan_x(Boundary boundary, Parity parity, double* modes);
  Pass plan_plane(int n, Boundary boundary, Parity parity, double* plane) const;

  void forward_along_x_and_y(const Field& in);
  void backward_along_x_and_y(Field& out);
  void exchange(const Plan& transpose) const;
  double* open_plane(int plane);
  void close_plane(int plane);
  void multiply(double* modes, const double* factor) const;

  Index3 n_;
  int z_begin_, n_layers_;      ///< layers of constant z on this rank
  bool complex_x_;              ///< two doubles a mode along x
  std::ptrdiff_t row_length_;   ///< doubles from row to row of modes
  int y_begin_ = 0, n_planes_;  ///< planes of constant y on this rank
  std::array<std::vector<double>, 3> theta_;
  double normalisation_ = 1;
  std::vector<double*> layer_;  ///< where each layer of modes is; with messages those of this rank only
  Buffer row_;                  ///< one row of values
  Buffer buffer_;               ///< all modes of this rank, unless they are shared
  Buffer plane_;                ///< one plane of modes, where planes are not contiguous in the buffer
  std::unique_ptr<parallel::SharedMemory> shared_;
  Plan forward_x_, backward_x_;
  Pass along_y_, along_z_;
  Plan to_planes_, to_layers_;  ///< with messages only
};

}  // namespace spume::grid
