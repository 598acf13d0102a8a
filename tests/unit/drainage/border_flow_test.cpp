// C_Δ from the flow itself: Stokes flow along a border between rigid faces is −μ Δu = G in the cross-section
// with u = 0 on its three arcs, so that the flux is (G/μ) ∫w with −Δw = 1, and C_Δ = ∫w/λ².
#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>
#include <numbers>
#include <vector>

#include "spume/drainage/constants.hpp"

namespace spume::drainage {
namespace {

using std::numbers::pi;

struct Polynomial {
  double value, slope;
};
/// Legendre polynomial P_n at −1 < x < 1.
Polynomial legendre(int n, double x) {
  if (n == 0) return {1, 0};
  const double value = std::legendre(n, x), below = std::legendre(n - 1, x);
  return {value, n * (below - x * value) / (1 - x * x)};
}

/// Gauss's rule on [0, 1].
struct Rule {
  std::vector<double> point, weight;
};
Rule gauss(int n) {
  Rule rule;
  for (int i = 0; i < n; ++i) {
    double x = std::cos(pi * (i + 0.75) / (n + 0.5));
    for (int newton = 0; newton < 50; ++newton) {
      const auto p = legendre(n, x);
      x -= p.value / p.slope;
    }
    const double slope = legendre(n, x).slope;
    rule.point.push_back(0.5 * (1 + x));
    rule.weight.push_back(1 / ((1 - x * x) * slope * slope));
  }
  return rule;
}

struct CrossSection {
  double area, flow;  ///< λ/r² and ∫w/r⁴
};

/// A sixth of the cross-section between three arcs of radius 1 that touch each other, seen from the centre of
/// one of them: angle 0 < α < π/6 from a point of contact, where the section is a cusp, to the middle;
/// distance 1 < ρ < sec α from the arc to a line of symmetry. Galerkin with n² functions
/// h² ξ P_j(ξ) P_k(α²), h = sec α − 1, ρ = 1 + h ξ: they vanish on the arc, fall as the flow does into the
/// cusp, and leave the lines of symmetry to the natural condition.
CrossSection solve(int n) {
  const int size = n * n;
  Eigen::MatrixXd stiffness = Eigen::MatrixXd::Zero(size, size);
  Eigen::VectorXd load = Eigen::VectorXd::Zero(size), along(size), across(size), value(size);
  const Rule rule = gauss(2 * n + 8);
  double area = 0;
  for (std::size_t a = 0; a < rule.point.size(); ++a)
    for (std::size_t b = 0; b < rule.point.size(); ++b) {
      const double t = rule.point[a], alpha = pi / 6 * t, xi = rule.point[b];
      const double h = 1 / std::cos(alpha) - 1,
                   h_slope = std::sin(alpha) / (std::cos(alpha) * std::cos(alpha));
      const double rho = 1 + h * xi, weight = 6 * pi / 6 * rule.weight[a] * rule.weight[b] * rho * h;
      for (int j = 0; j < n; ++j)
        for (int k = 0; k < n; ++k) {
          const Polynomial p = legendre(j, 2 * xi - 1), q = legendre(k, 2 * t * t - 1);
          const double f = xi * p.value, f_slope = p.value + 2 * xi * p.slope;  // by ξ
          const double q_slope = q.slope * 4 * t / (pi / 6);                    // by α
          const int m = j * n + k;
          value(m) = h * h * f * q.value;
          along(m) = h * f_slope * q.value;  // ∂/∂ρ
          across(m) =
              (2 * h * h_slope * f * q.value + h * h * f * q_slope - h * h_slope * xi * f_slope * q.value) /
              rho;  // (1/ρ) ∂/∂α with ρ held
        }
      stiffness += weight * (along * along.transpose() + across * across.transpose());
      load += weight * value;
      area += weight;
    }
  return {area, load.dot(stiffness.ldlt().solve(load))};
}

TEST(BorderFlow, is_that_of_stokes_flow_between_three_arcs_that_touch) {
  const CrossSection coarse = solve(9), fine = solve(12);
  EXPECT_NEAR(fine.area, border_shape, 1e-12);  // λ = (√3 − π/2) r²
  const double c = fine.flow / (fine.area * fine.area);
  EXPECT_NEAR(coarse.flow / fine.flow, 1, 1e-7);  // the series has converged
  EXPECT_NEAR(c, 0.02009871, 1e-8);
  EXPECT_NEAR(1 / c, 49.7544, 1e-4);
  EXPECT_NEAR(border_flow, c, 0.5e-7);  // the constant is c to its last digit
}

}  // namespace
}  // namespace spume::drainage
