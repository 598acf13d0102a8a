#pragma once

#include <memory>
#include <span>

namespace spume::fem {

/// A direct solver for one sparse matrix whose pattern stays while its values change: the pattern is analysed
/// once, the values are factorised often.
class SparseLu {
 public:
  /// A square matrix by columns: the rows of column j are row[column_offset[j] … column_offset[j+1]),
  /// increasing. Fastest if the pattern is symmetric or nearly so and has every diagonal entry.
  SparseLu(std::span<const int> column_offset, std::span<const int> row);
  ~SparseLu();
  SparseLu(SparseLu&&) noexcept;
  SparseLu& operator=(SparseLu&&) noexcept;

  /// Factorises the matrix with these values, in the order of the pattern.
  /// False if it is singular or not finite; then solve() must not be called.
  bool factorise(std::span<const double> value);

  /// Replaces the right side by the solution of A x = right.
  void solve(std::span<double> right);

 private:
  struct Factors;
  std::unique_ptr<Factors> factors_;
};

}  // namespace spume::fem
