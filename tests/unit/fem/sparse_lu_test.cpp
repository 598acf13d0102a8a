#include "spume/fem/sparse_lu.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <vector>

namespace spume::fem {
namespace {

/// Tridiagonal n × n matrix with these entries below, on and above the diagonal, by columns.
struct Tridiagonal {
  std::vector<int> offset{0}, row;
  std::vector<double> value;

  Tridiagonal(int n, double below, double on, double above) {
    for (int j = 0; j < n; ++j) {
      if (j > 0) add(j - 1, above);
      add(j, on);
      if (j + 1 < n) add(j + 1, below);
      offset.push_back(static_cast<int>(row.size()));
    }
  }
  void add(int i, double v) {
    row.push_back(i);
    value.push_back(v);
  }
  std::vector<double> times(const std::vector<double>& x) const {
    std::vector<double> y(x.size(), 0.0);
    for (std::size_t j = 0; j + 1 < offset.size(); ++j)
      for (int p = offset[j]; p < offset[j + 1]; ++p) y[row[p]] += value[p] * x[j];
    return y;
  }
};

/// Solves with a known solution and compares; the matrices below have condition numbers under 1e4.
void expect_solves(SparseLu& lu, const Tridiagonal& matrix, int n) {
  std::vector<double> x;
  for (int i = 0; i < n; ++i) x.push_back(1 + i % 7);
  std::vector<double> b = matrix.times(x);
  lu.solve(b);
  for (int i = 0; i < n; ++i) EXPECT_NEAR(b[i], x[i], 1e-11);
}

TEST(SparseLu, solves_again_with_other_values_in_the_same_pattern) {
  const int n = 50;
  const Tridiagonal first(n, -1, 2.1, -1), second(n, 3, 5, -1.5);
  SparseLu lu(first.offset, first.row);
  ASSERT_TRUE(lu.factorise(first.value));
  expect_solves(lu, first, n);
  ASSERT_TRUE(lu.factorise(second.value));
  expect_solves(lu, second, n);
}

TEST(SparseLu, chooses_new_pivots_where_the_old_ones_would_ruin_the_numbers) {
  // Diagonal pivots are right for the first matrix and useless for the second, whose diagonal is all but
  // empty. An even n keeps it regular.
  const int n = 50;
  const Tridiagonal first(n, 0.1, 1, 0.1), second(n, 1, 1e-13, 1.2);
  SparseLu lu(first.offset, first.row);
  ASSERT_TRUE(lu.factorise(first.value));
  ASSERT_TRUE(lu.factorise(second.value));
  expect_solves(lu, second, n);
}

TEST(SparseLu, refuses_what_is_singular_or_not_finite_and_recovers) {
  const int n = 10;
  const Tridiagonal good(n, -1, 3, -1);
  SparseLu lu(good.offset, good.row);
  std::vector<double> bad(good.value.size(), 0.0);
  EXPECT_FALSE(lu.factorise(bad));
  bad = good.value;
  bad[3] = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(lu.factorise(bad));
  ASSERT_TRUE(lu.factorise(good.value));
  expect_solves(lu, good, n);
}

}  // namespace
}  // namespace spume::fem
