#include "spume/fem/sparse_lu.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>
#include <vector>

namespace spume::fem {
namespace {

/// A matrix by columns.
struct Matrix {
  std::vector<int> offset{0}, row;
  std::vector<double> value;

  void add(int i, double v) {
    row.push_back(i);
    value.push_back(v);
  }
  void end_column() { offset.push_back(static_cast<int>(row.size())); }
  std::vector<double> times(const std::vector<double>& x) const {
    std::vector<double> y(x.size(), 0.0);
    for (std::size_t j = 0; j + 1 < offset.size(); ++j)
      for (int p = offset[j]; p < offset[j + 1]; ++p) y[row[p]] += value[p] * x[j];
    return y;
  }
};

/// Tridiagonal n × n matrix with these entries below, on and above the diagonal.
Matrix tridiagonal(int n, double below, double on, double above) {
  Matrix matrix;
  for (int j = 0; j < n; ++j) {
    if (j > 0) matrix.add(j - 1, above);
    matrix.add(j, on);
    if (j + 1 < n) matrix.add(j + 1, below);
    matrix.end_column();
  }
  return matrix;
}

/// A matrix on an n × n grid of points, each coupled to those within two steps, with entries of its own for
/// each pair in each direction: the pattern of films, not symmetric in its values.
Matrix grid(int n, double diagonal, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> entry(-1, 1);
  Matrix matrix;
  for (int j = 0; j < n * n; ++j) {
    for (int i = 0; i < n * n; ++i)
      if (std::abs(i % n - j % n) + std::abs(i / n - j / n) <= 2)
        matrix.add(i, i == j ? diagonal : entry(random));
    matrix.end_column();
  }
  return matrix;
}

/// Solves with a known solution and compares; the matrices below, their rows scaled, have condition numbers
/// under 1e4.
void expect_solves(SparseLu& lu, const Matrix& matrix) {
  const auto n = static_cast<int>(matrix.offset.size()) - 1;
  std::vector<double> x;
  for (int i = 0; i < n; ++i) x.push_back(1 + i % 7);
  std::vector<double> b = matrix.times(x);
  lu.solve(b);
  for (int i = 0; i < n; ++i) EXPECT_NEAR(b[i], x[i], 1e-11);
}

TEST(SparseLu, solves_again_with_other_values_in_the_same_pattern) {
  const int n = 50;
  const Matrix first = tridiagonal(n, -1, 2.1, -1), second = tridiagonal(n, 3, 5, -1.5);
  SparseLu lu(first.offset, first.row);
  ASSERT_TRUE(lu.factorise(first.value));
  expect_solves(lu, first);
  ASSERT_TRUE(lu.factorise(second.value));
  expect_solves(lu, second);
}

TEST(SparseLu, solves_on_grids_of_one_point_and_of_many) {
  for (int n : {1, 2, 7, 30}) {
    const Matrix first = grid(n, 15, 1), second = grid(n, -20, 2);
    SparseLu lu(first.offset, first.row);
    ASSERT_TRUE(lu.factorise(first.value));
    expect_solves(lu, first);
    ASSERT_TRUE(lu.factorise(second.value));
    expect_solves(lu, second);
  }
}

TEST(SparseLu, bears_rows_of_very_different_size) {
  Matrix matrix = grid(20, 15, 4);
  for (std::size_t p = 0; p < matrix.value.size(); ++p)
    matrix.value[p] *= std::pow(10.0, -(matrix.row[p] % 25));
  SparseLu lu(matrix.offset, matrix.row);
  ASSERT_TRUE(lu.factorise(matrix.value));
  expect_solves(lu, matrix);
}

TEST(SparseLu, chooses_new_pivots_where_the_old_ones_would_ruin_the_numbers) {
  // Diagonal pivots are right for the first matrix and useless for the second, whose diagonal is all but
  // empty. An even n keeps it regular.
  const int n = 50;
  const Matrix first = tridiagonal(n, 0.1, 1, 0.1), second = tridiagonal(n, 1, 1e-13, 1.2);
  SparseLu lu(first.offset, first.row);
  ASSERT_TRUE(lu.factorise(first.value));
  ASSERT_TRUE(lu.factorise(second.value));
  expect_solves(lu, second);
}

TEST(SparseLu, refuses_what_is_singular_or_not_finite_and_recovers) {
  const int n = 10;
  const Matrix good = tridiagonal(n, -1, 3, -1);
  SparseLu lu(good.offset, good.row);
  std::vector<double> bad(good.value.size(), 0.0);
  EXPECT_FALSE(lu.factorise(bad));
  bad = good.value;
  bad[3] = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(lu.factorise(bad));
  ASSERT_TRUE(lu.factorise(good.value));
  expect_solves(lu, good);
}

}  // namespace
}  // namespace spume::fem
