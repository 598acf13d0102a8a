#include "spume/fem/tridiagonal.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "spume/base/error.hpp"

namespace spume::fem {
namespace {

/// A matrix with entries of either sign, diagonally dominant.
SymmetricTridiagonal matrix_of(int n, bool ring) {
  SymmetricTridiagonal matrix;
  matrix.reset(n, ring);
  for (int i = 0; i < n; ++i) matrix.diagonal[i] = 3 + std::sin(2.0 * i);
  for (std::size_t i = 0; i < matrix.off.size(); ++i) matrix.off[i] = 0.9 * std::cos(3.0 * i);
  return matrix;
}

std::vector<double> multiply(const SymmetricTridiagonal& matrix, const std::vector<double>& x) {
  std::vector<double> product(x.size());
  for (std::size_t i = 0; i < x.size(); ++i) product[i] = matrix.diagonal[i] * x[i];
  for (std::size_t i = 0; i < matrix.off.size(); ++i) {
    const std::size_t j = (i + 1) % x.size();
    product[i] += matrix.off[i] * x[j];
    product[j] += matrix.off[i] * x[i];
  }
  return product;
}

TEST(SymmetricTridiagonal, solves_rows_and_rings_of_any_size) {
  for (const bool ring : {false, true})
    for (const int n : {1, 2, 3, 4, 50}) {
      if (ring && n < 3) continue;
      SymmetricTridiagonal matrix = matrix_of(n, ring);
      std::vector<double> x;
      for (int i = 0; i < n; ++i) x.push_back(1 + std::sin(5.0 * i));
      std::vector<double> right = multiply(matrix, x);
      matrix.solve(right);
      for (int i = 0; i < n; ++i) EXPECT_NEAR(right[i], x[i], 1e-14) << n << " unknowns, ring " << ring;
    }
}

TEST(SymmetricTridiagonal, solves_again_with_other_right_sides) {
  SymmetricTridiagonal matrix = matrix_of(5, true);
  for (const double scale : {1.0, 7.0}) {
    std::vector<double> right = multiply(matrix, std::vector<double>(5, scale));
    matrix.solve(right);
    for (double v : right) EXPECT_NEAR(v, scale, 1e-14 * scale);
  }
}

TEST(SymmetricTridiagonal, refuses_a_ring_of_two) {
  SymmetricTridiagonal matrix;
  EXPECT_ANY_THROW(matrix.reset(2, true));
}

}  // namespace
}  // namespace spume::fem
