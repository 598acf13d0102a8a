#pragma once

#include <span>
#include <vector>

namespace spume::fem {

/// A symmetric matrix whose unknowns stand in a row, or in a ring: entry off[i] couples i and i + 1, and in a
/// ring off[n − 1] couples the last with the first.
class SymmetricTridiagonal {
 public:
  std::vector<double> diagonal, off;

  /// Makes room for n unknowns and sets all entries to zero. Takes: n ≥ 1, in a ring n ≥ 3.
  void reset(int n, bool ring);
  /// Replaces the right side by the solution, in linear time without pivots: right for positive definite
  /// matrices.
  void solve(std::span<double> right);

 private:
  void eliminate(std::span<double> right);

  std::vector<double> ratio_, pivot_, correction_;
};

}  // namespace spume::fem
