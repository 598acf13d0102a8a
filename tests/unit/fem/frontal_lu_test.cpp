#include "spume/fem/frontal_lu.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <vector>

namespace spume::fem {
namespace {

/// A matrix on an n × n grid of points, each coupled to those within two steps, with entries of its own for
/// each pair in each direction: the pattern of films, not symmetric in its values.
struct GridMatrix {
  std::vector<int> offset{0}, row;
  std::vector<double> value;

  GridMatrix(int n, double diagonal, unsigned seed) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> entry(-1, 1);
    for (int j = 0; j < n * n; ++j) {
      for (int i = 0; i < n * n; ++i) {
        const int steps = std::abs(i % n - j % n) + std::abs(i / n - j / n);
        if (steps > 2) continue;
        row.push_back(i);
        value.push_back(i == j ? diagonal : entry(random));
      }
      offset.push_back(static_cast<int>(row.size()));
    }
  }
  std::vector<double> times(const std::vector<double>& x) const {
    std::vector<double> y(x.size(), 0.0);
    for (std::size_t j = 0; j + 1 < offset.size(); ++j)
      for (int p = offset[j]; p < offset[j + 1]; ++p) y[row[p]] += value[p] * x[j];
    return y;
  }
};

double largest_error(FrontalLu& lu, const GridMatrix& matrix) {
  std::vector<double> x;
  for (std::size_t i = 0; i + 1 < matrix.offset.size(); ++i) x.push_back(1 + static_cast<double>(i % 7));
  std::vector<double> b = matrix.times(x);
  lu.solve(b);
  double error = 0;
  for (std::size_t i = 0; i < x.size(); ++i) error = std::max(error, std::abs(b[i] - x[i]));
  return error;
}

TEST(FrontalLu, solves_again_with_other_values_in_the_same_pattern) {
  // Dominant diagonals: condition numbers near one.
  for (int n : {1, 2, 7, 30}) {
    const GridMatrix first(n, 15, 1), second(n, -20, 2);
    FrontalLu lu(first.offset, first.row);
    ASSERT_TRUE(lu.factorise(first.value));
    EXPECT_LT(largest_error(lu, first), 1e-12);
    ASSERT_TRUE(lu.factorise(second.value));
    EXPECT_LT(largest_error(lu, second), 1e-12);
  }
}

TEST(FrontalLu, exchanges_rows_within_a_front) {
  // Without dominance the pivots on the diagonal alone would be poor.
  const GridMatrix matrix(12, 0.5, 3);
  FrontalLu lu(matrix.offset, matrix.row);
  ASSERT_TRUE(lu.factorise(matrix.value));
  EXPECT_LT(largest_error(lu, matrix), 1e-7);
}

TEST(FrontalLu, bears_rows_of_very_different_size) {
  GridMatrix matrix(20, 15, 4);
  for (std::size_t p = 0; p < matrix.value.size(); ++p)
    matrix.value[p] *= std::pow(10.0, -(matrix.row[p] % 25));
  FrontalLu lu(matrix.offset, matrix.row);
  ASSERT_TRUE(lu.factorise(matrix.value));
  EXPECT_LT(largest_error(lu, matrix), 1e-11);
}

TEST(FrontalLu, says_where_it_finds_no_pivots) {
  GridMatrix matrix(10, 15, 5);
  FrontalLu lu(matrix.offset, matrix.row);
  const auto good = matrix.value;
  for (std::size_t p = 0; p < matrix.value.size(); ++p)
    if (matrix.row[p] == 37) matrix.value[p] = 0;
  EXPECT_FALSE(lu.factorise(matrix.value));
  matrix.value = good;
  matrix.value[200] = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(lu.factorise(matrix.value));
  EXPECT_TRUE(lu.factorise(good));
}

}  // namespace
}  // namespace spume::fem
