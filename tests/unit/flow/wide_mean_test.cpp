#include "spume/flow/wide_mean.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace spume {
namespace {

using flow::wide_difference;
using flow::wide_mean;

/// ∫ of e^x over a width h about x, over h.
double mean_of_exponential(double x, double h) {
  return std::exp(x) * 2 * std::sinh(0.5 * h) / h;
}

TEST(WideMean, OfMeansOverCellsIsTheValueBetweenThemToFourthOrder) {
  const auto error = [](double h) {
    return std::abs(wide_mean(mean_of_exponential(-1.5 * h, h), mean_of_exponential(-0.5 * h, h),
                              mean_of_exponential(0.5 * h, h), mean_of_exponential(1.5 * h, h)) -
                    1);
  };
  EXPECT_NEAR(std::log2(error(0.2) / error(0.1)), 4.0, 0.02);
}

TEST(WideMean, DifferenceIsTheDerivativeToFourthOrder) {
  const auto error = [](double h) {
    return std::abs(wide_difference(std::exp(-2 * h), std::exp(-h), std::exp(h), std::exp(2 * h)) / h - 1);
  };
  EXPECT_NEAR(std::log2(error(0.2) / error(0.1)), 4.0, 0.02);
}

TEST(WideMean, DifferenceIsThatOfTheMeansOnBothSides) {
  const double f[] = {0.3, -1.1, 2.7, 0.9, -0.4};
  EXPECT_NEAR(wide_difference(f[0], f[1], f[3], f[4]),
              wide_mean(f[1], f[2], f[3], f[4]) - wide_mean(f[0], f[1], f[2], f[3]), 1e-15);
}

}  // namespace
}  // namespace spume
