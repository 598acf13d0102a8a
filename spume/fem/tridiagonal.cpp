#include "spume/fem/tridiagonal.hpp"

#include "spume/base/contract.hpp"

namespace spume::fem {

void SymmetricTridiagonal::reset(int n, bool ring) {
  expects(n >= (ring ? 3 : 1), "at least one unknown in a row, three in a ring");
  diagonal.assign(n, 0.0);
  off.assign(ring ? n : n - 1, 0.0);
}

/// Solves with the row pivot_ on the diagonal; leaves the factors for a second right side.
void SymmetricTridiagonal::eliminate(std::span<double> right) {
  const std::size_t n = diagonal.size();
  ratio_.resize(n);
  double pivot = pivot_[0];
  right[0] /= pivot;
  for (std::size_t i = 1; i < n; ++i) {
    ratio_[i] = off[i - 1] / pivot;
    pivot = pivot_[i] - off[i - 1] * ratio_[i];
    right[i] = (right[i] - off[i - 1] * right[i - 1]) / pivot;
  }
  for (std::size_t i = n - 1; i > 0; --i) right[i - 1] -= ratio_[i] * right[i];
}

void SymmetricTridiagonal::solve(std::span<double> right) {
  const std::size_t n = diagonal.size();
  expects(right.size() == n, "one right side per unknown");
  pivot_ = diagonal;
  if (off.size() < n) {
    eliminate(right);
    return;
  }
  // Sherman and Morrison: the ring is a row plus u uᵀ/γ, u = (γ, 0, …, 0, c), c the link of the ends.
  const double gamma = -diagonal[0], link = off[n - 1];
  pivot_[0] -= gamma;
  pivot_[n - 1] -= link * link / gamma;
  correction_.assign(n, 0.0);
  correction_[0] = gamma;
  correction_[n - 1] = link;
  eliminate(right);
  eliminate(correction_);
  const double ratio = link / gamma;
  const double factor = (right[0] + ratio * right[n - 1]) / (1 + correction_[0] + ratio * correction_[n - 1]);
  for (std::size_t i = 0; i < n; ++i) right[i] -= factor * correction_[i];
}

}  // namespace spume::fem
