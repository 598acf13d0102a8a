#include "spume/fem/lagged_lu.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace spume::fem {
namespace {

constexpr int n = 200;
const std::vector<double> ones(n, 1.0);

std::vector<int> offsets() {
  std::vector<int> offset{0};
  for (int j = 0; j < n; ++j) offset.push_back(offset.back() + 1 + (j > 0) + (j + 1 < n));
  return offset;
}

std::vector<int> rows() {
  std::vector<int> row;
  for (int j = 0; j < n; ++j)
    for (int i = std::max(0, j - 1); i <= std::min(n - 1, j + 1); ++i) row.push_back(i);
  return row;
}

/// Unity and s times diffusion on a line, its mobility uneven by `uneven`.
std::vector<double> diffusion(double s, double uneven) {
  const auto mobility = [=](int edge) { return s * (1 + uneven * std::sin(0.1 * edge)); };
  std::vector<double> value;
  for (int j = 0; j < n; ++j) {
    if (j > 0) value.push_back(-mobility(j));
    value.push_back(1 + (j > 0 ? mobility(j) : 0) + (j + 1 < n ? mobility(j + 1) : 0));
    if (j + 1 < n) value.push_back(-mobility(j + 1));
  }
  return value;
}

/// Largest error of a solution whose largest entry is one.
double error_of_solution(LaggedLu& lu, const std::vector<double>& value) {
  const auto offset = offsets(), row = rows();
  std::vector<double> x, b(n, 0.0);
  for (int j = 0; j < n; ++j) x.push_back(std::cos(0.02 * j));
  for (int j = 0; j < n; ++j)
    for (int p = offset[j]; p < offset[j + 1]; ++p) b[row[p]] += value[p] * x[j];
  EXPECT_TRUE(lu.assign(value));
  lu.solve(b, ones, ones);
  double largest = 0;
  for (int i = 0; i < n; ++i) largest = std::max(largest, std::abs(b[i] - x[i]));
  return largest;
}

TEST(LaggedLu, solves_with_a_matrix_that_changed_a_little_without_new_factors) {
  LaggedLu lu(offsets(), rows());
  EXPECT_LT(error_of_solution(lu, diffusion(100, 0.1)), 1e-11);  // direct
  // Three times what is asked for, which is an estimate from one step of the iteration to the next.
  EXPECT_LT(error_of_solution(lu, diffusion(120, 0.2)), 3 * LaggedLu::tolerance);
  EXPECT_EQ(lu.n_factorisations(), 1);
}

TEST(LaggedLu, makes_new_factors_where_the_matrix_has_changed_much) {
  LaggedLu lu(offsets(), rows());
  error_of_solution(lu, diffusion(1e-3, 0));
  EXPECT_LT(error_of_solution(lu, diffusion(1e4, 0.9)), 1e-9);  // direct, condition number 1e5
  EXPECT_EQ(lu.n_factorisations(), 2);
}

TEST(LaggedLu, makes_new_factors_when_iterations_have_cost_as_much) {
  LaggedLu lu(offsets(), rows());
  error_of_solution(lu, diffusion(100, 0));
  for (int again = 0; again < 40; ++again)
    EXPECT_LT(error_of_solution(lu, diffusion(100, 0.3 + 0.3 * (again % 2))), 3 * LaggedLu::tolerance);
  EXPECT_GT(lu.n_factorisations(), 2);
  EXPECT_LT(lu.n_factorisations(), 20);
}

TEST(LaggedLu, refuses_what_is_not_finite_tells_what_is_singular_and_recovers) {
  LaggedLu lu(offsets(), rows());
  auto bad = diffusion(1, 0);
  bad[3] = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(lu.assign(bad));
  EXPECT_LT(error_of_solution(lu, diffusion(1, 0)), 1e-12);
  EXPECT_FALSE(lu.assign(bad));
  ASSERT_TRUE(lu.assign(std::vector<double>(bad.size(), 0.0)));  // singular, as the solve finds out
  std::vector<double> b(n, 1.0);
  lu.solve(b, ones, ones);
  EXPECT_TRUE(std::isnan(b[0]));
  EXPECT_LT(error_of_solution(lu, diffusion(1, 0)), 1e-12);
}

}  // namespace
}  // namespace spume::fem
