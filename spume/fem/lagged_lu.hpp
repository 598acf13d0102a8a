#pragma once

#include <span>
#include <vector>

#include "spume/fem/sparse_lu.hpp"

namespace spume::fem {

/// Solves with a sparse matrix whose values change a little from one use to the next. The factors of an
/// earlier matrix precondition a generalised conjugate residual iteration (Eisenstat, Elman, Schultz, SIAM J.
/// Numer. Anal. 20, 1983) with the present one; a new factorisation is made only when the iterations since
/// the last have cost as much as one, or where they do not converge. What is solved is always the present
/// system, to `tolerance`; the old factors decide the time alone.
class LaggedLu {
 public:
  /// What is left of the error of a solution, relative to the solution, both in units of the scale.
  static constexpr double tolerance = 1e-4;

  /// A square matrix by columns, as for SparseLu.
  LaggedLu(std::span<const int> column_offset, std::span<const int> row);

  /// Takes these values, in the order of the pattern. False if they are not finite, or cannot be factorised
  /// where that is due; then solve() must not be called.
  bool assign(std::span<const double> value);

  /// Replaces the right side by the solution x of A x = right, wherein |x_i| / scale_i is what counts,
  /// scale > 0. `weight` > 0, of each row, makes the norm Σ weight r² of the residual. Not a number
  /// throughout if a factorisation is due and fails.
  void solve(std::span<double> right, std::span<const double> scale, std::span<const double> weight);

  int n_factorisations() const { return n_factorisations_; }

 private:
  static constexpr int most_iterations = 10;
  /// A factorisation takes the time of 25 to 15 iterations on films of 750 to 17,000 unknowns; from 12 to 24,
  /// the whole time changes by 5 % (docs/decisions/0007-positive-drainage.md).
  static constexpr int worth_of_factorisation = 16;

  bool factorise();
  /// False if not converged; then x is of no use.
  bool iterate(std::span<const double> right, std::span<const double> scale, std::span<const double> weight);
  /// z = B⁻¹ r and q = A z of iteration n, orthogonal to those before and of length one; |q| before that.
  double new_direction(int n, std::span<const double> weight);
  void multiply(std::span<const double> x, std::span<double> y) const;

  std::vector<int> column_offset_, row_;
  std::vector<double> value_;
  SparseLu lu_;
  bool factorised_ = false, current_ = false;
  int iterations_ = 0, n_factorisations_ = 0;  ///< iterations_: beyond the first of each solve
  std::vector<double> x_, residual_;
  std::vector<std::vector<double>> z_, q_;
};

}  // namespace spume::fem
