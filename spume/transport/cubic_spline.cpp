#include "spume/transport/cubic_spline.hpp"

#include "spume/base/contract.hpp"

namespace spume::transport {

namespace {

/// lower[k] x[k−1] + diagonal[k] x[k] + upper[k] x[k+1] = right[k].
struct Tridiagonal {
  std::vector<double> lower, diagonal, upper;

  explicit Tridiagonal(std::size_t n) : lower(n, 0), diagonal(n, 0), upper(n, 0) {}

  /// Elimination without pivoting: the rows below are diagonally dominant, or as good (de Boor).
  std::vector<double> solve(std::vector<double> x) const {
    const std::size_t n = x.size();
    std::vector<double> d = diagonal;
    for (std::size_t k = 1; k < n; ++k) {
      const double factor = lower[k] / d[k - 1];
      d[k] -= factor * upper[k - 1];
      x[k] -= factor * x[k - 1];
    }
    x[n - 1] /= d[n - 1];
    for (std::size_t k = n - 1; k-- > 0;) x[k] = (x[k] - upper[k] * x[k + 1]) / d[k];
    return x;
  }
};

}  // namespace

std::vector<double> spline_slopes(std::span<const double> s, std::span<const double> f) {
  const std::size_t n = s.size();
  expects(n >= 4 && f.size() == n, "a not-a-knot spline needs four knots");
  const auto width = [&](std::size_t k) { return s[k + 1] - s[k]; };
  const auto secant = [&](std::size_t k) { return (f[k + 1] - f[k]) / width(k); };
  Tridiagonal matrix(n);
  std::vector<double> right(n);
  for (std::size_t k = 1; k + 1 < n; ++k) {
    matrix.lower[k] = width(k);
    matrix.diagonal[k] = 2 * (width(k - 1) + width(k));
    matrix.upper[k] = width(k - 1);
    right[k] = 3 * (width(k) * secant(k - 1) + width(k - 1) * secant(k));
  }
  {
    const double both = s[2] - s[0];
    matrix.diagonal[0] = width(1);
    matrix.upper[0] = both;
    right[0] = ((width(0) + 2 * both) * width(1) * secant(0) + width(0) * width(0) * secant(1)) / both;
  }
  {
    const double last = width(n - 2), both = s[n - 1] - s[n - 3];
    matrix.diagonal[n - 1] = width(n - 3);
    matrix.lower[n - 1] = both;
    right[n - 1] = (last * last * secant(n - 3) + (2 * both + last) * width(n - 3) * secant(n - 2)) / both;
  }
  return matrix.solve(std::move(right));
}

std::vector<double> periodic_spline_slopes(std::span<const double> s, std::span<const double> f) {
  const std::size_t n = s.size() - 1;
  expects(n >= 3 && f.size() == n + 1, "a periodic spline needs three different knots");
  const auto width = [&](std::size_t k) { return s[k + 1] - s[k]; };
  const auto secant = [&](std::size_t k) { return (f[k + 1] - f[k]) / width(k); };
  Tridiagonal matrix(n);
  std::vector<double> right(n);
  for (std::size_t k = 0; k < n; ++k) {
    const std::size_t before = (k + n - 1) % n;
    matrix.lower[k] = width(k);
    matrix.diagonal[k] = 2 * (width(before) + width(k));
    matrix.upper[k] = width(before);
    right[k] = 3 * (width(k) * secant(before) + width(before) * secant(k));
  }
  // Sherman–Morrison for the two corners: matrix = T + p qᵀ, p = (γ, 0 … 0, upper), q = (1, 0 … 0, lower/γ).
  const double corner_low = matrix.lower[0], corner_high = matrix.upper[n - 1];
  const double gamma = -matrix.diagonal[0];
  matrix.diagonal[0] -= gamma;
  matrix.diagonal[n - 1] -= corner_low * corner_high / gamma;
  std::vector<double> p(n, 0);
  p[0] = gamma;
  p[n - 1] = corner_high;
  std::vector<double> slope = matrix.solve(std::move(right));
  const std::vector<double> z = matrix.solve(std::move(p));
  const double share = corner_low / gamma;
  const double factor = (slope[0] + share * slope[n - 1]) / (1 + z[0] + share * z[n - 1]);
  for (std::size_t k = 0; k < n; ++k) slope[k] -= factor * z[k];
  slope.push_back(slope.front());
  return slope;
}

double hermite(double t, double length, double f0, double f1, double d0, double d1) {
  const double u = 1 - t;
  return u * u * (1 + 2 * t) * f0 + t * t * (1 + 2 * u) * f1 + length * t * u * (u * d0 - t * d1);
}

}  // namespace spume::transport
