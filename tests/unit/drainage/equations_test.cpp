#include "spume/drainage/equations.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "spume/verification/four_borders.hpp"

namespace spume::drainage {
namespace {

/// Four borders between two junctions, and a ring of five edges.
BorderNetwork borders_and_a_ring() {
  BorderNetwork borders = verification::share_junctions(verification::four_borders(8)).network;
  const int n = 5, first = borders.size();
  for (int i = 0; i < n; ++i) {
    const double h = 0.3;
    borders.vertex.push_back(first + i);
    borders.length.push_back(h);
    borders.link.push_back({{first + i, first + (i + 1) % n}, h, 0.1 * h * std::sin(2.0 * i)});
  }
  return borders;
}

TEST(DrainageEquations, solve_the_linearised_balances_of_borders) {
  DrainageEquations equations(borders_and_a_ring(), verification::four_borders_materials());
  const int n = equations.borders().size();
  Unknowns y, given;
  for (int u = 0; u < n; ++u) {
    y.border.push_back(2 + std::sin(3.0 * u));
    given.border.push_back(1 + std::cos(5.0 * u));
  }
  Unknowns rate, again;
  equations.linearise(y, rate);
  equations.rates(y, again);
  for (int u = 0; u < n; ++u)
    EXPECT_NEAR(rate.border[u], again.border[u], 1e-15);  // round-off of terms of 0.1

  const double s = 2;  // a few times that in which an edge empties
  Unknowns k = given;
  ASSERT_TRUE(equations.factorise(s));
  equations.solve(k);
  // M k − s J k = b, J k by differences, whose error is the square of their relative size.
  const double d = 1e-5;
  Unknowns forth = y, back = y, rate_forth, rate_back;
  for (int u = 0; u < n; ++u) {
    forth.border[u] += d * k.border[u];
    back.border[u] -= d * k.border[u];
  }
  equations.rates(forth, rate_forth);
  equations.rates(back, rate_back);
  double implicit = 0;
  for (int u = 0; u < n; ++u) {
    const double slope = (rate_forth.border[u] - rate_back.border[u]) / (2 * d);
    EXPECT_NEAR(equations.border_length()[u] * k.border[u] - s * slope, given.border[u], 1e-8);
    implicit = std::max(implicit, std::abs(s * slope));
  }
  EXPECT_GT(implicit, 0.1);  // the step is not all but explicit
}

}  // namespace
}  // namespace spume::drainage
