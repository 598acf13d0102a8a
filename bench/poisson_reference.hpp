#pragma once

#include <fftw3.h>

#include <algorithm>
#include <cstddef>
#include <vector>

namespace spume::bench {

/// The unit in which steps are measured: one exact periodic Poisson solve on n³ cells by one core, in place,
/// with FFTW's best plans: real-to-complex transform, one factor a mode, and back.
class PoissonReference {
 public:
  explicit PoissonReference(int n) : n_(n), modes_(n / 2 + 1) {
    const std::size_t size = static_cast<std::size_t>(n) * n * modes_ * 2;
    values_ = fftw_alloc_real(size);
    auto* modes = reinterpret_cast<fftw_complex*>(values_);
    forward_ = fftw_plan_dft_r2c_3d(n, n, n, values_, modes, FFTW_MEASURE);
    backward_ = fftw_plan_dft_c2r_3d(n, n, n, modes, values_, FFTW_MEASURE);
    for (std::size_t c = 0; c < size; ++c) values_[c] = static_cast<double>(c * 7919 % 1013) - 506;
    eigenvalue_.resize(n);
    for (int m = 0; m < n; ++m) eigenvalue_[m] = 1e-3 + std::min(m, n - m) * std::min(m, n - m);
  }
  ~PoissonReference() {
    fftw_destroy_plan(forward_);
    fftw_destroy_plan(backward_);
    fftw_free(values_);
  }
  PoissonReference(const PoissonReference&) = delete;
  PoissonReference& operator=(const PoissonReference&) = delete;

  void solve() {
    fftw_execute(forward_);
    double* mode = values_;
    const double scale = 1e-3 / (static_cast<double>(n_) * n_ * n_);
    for (int k = 0; k < n_; ++k)
      for (int j = 0; j < n_; ++j, mode += 2 * modes_) {
        const double yz = eigenvalue_[j] + eigenvalue_[k];
        for (int i = 0; i < modes_; ++i) {
          const double factor = scale / (eigenvalue_[i] + yz);
          mode[2 * i] *= factor;
          mode[2 * i + 1] *= factor;
        }
      }
    fftw_execute(backward_);
  }

 private:
  int n_, modes_;
  double* values_;
  fftw_plan forward_, backward_;
  std::vector<double> eigenvalue_;
};

}  // namespace spume::bench
