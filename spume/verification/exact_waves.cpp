#include "spume/verification/exact_waves.hpp"

#include <array>
#include <cmath>
#include <functional>
#include <numbers>

#include "spume/base/contract.hpp"
#include "spume/base/error.hpp"

namespace spume::verification {

namespace {

using Complex = std::complex<double>;
using std::numbers::pi;

/// Root of f near s by Newton's method with a central difference for the derivative.
Complex newton(const std::function<Complex(Complex)>& f, Complex s) {
  for (int n = 0; n < 50; ++n) {
    const double step = 1e-6 * std::abs(s);
    const Complex slope = (f(s + step) - f(s - step)) / (2 * step);
    const Complex change = f(s) / slope;
    s -= change;
    if (std::abs(change) < 1e-13 * std::abs(s)) return s;
  }
  throw NumericalError("dispersion relation: Newton's method did not converge");
}

Decay decay(Complex s) {
  return {.omega = std::abs(s.imag()), .gamma = -s.real()};
}

/// Roots of z⁴ + c[3] z³ + c[2] z² + c[1] z + c[0] by simultaneous iteration (Durand and Kerner).
std::vector<Complex> quartic_roots(const std::array<double, 4>& c) {
  const double size = std::max({std::abs(c[3]), std::sqrt(std::abs(c[2])), std::cbrt(std::abs(c[1])),
                                std::sqrt(std::sqrt(std::abs(c[0])))});
  std::vector<Complex> z(4);
  for (int i = 0; i < 4; ++i) z[i] = size * std::pow(Complex{0.4, 0.9}, i);
  for (int n = 0; n < 500; ++n) {
    double largest = 0;
    for (int i = 0; i < 4; ++i) {
      Complex value = (((z[i] + c[3]) * z[i] + c[2]) * z[i] + c[1]) * z[i] + c[0];
      for (int j = 0; j < 4; ++j)
        if (j != i) value /= z[i] - z[j];
      z[i] -= value;
      largest = std::max(largest, std::abs(value));
    }
    if (largest < 1e-15 * size) break;
  }
  return z;
}

/// The Faddeeva function w(z) = exp(−z²) erfc(−iz) for Im z ≥ 0.
Complex faddeeva(Complex z) {
  constexpr int n = 40, m = 2 * n;
  const double length = std::sqrt(n / std::numbers::sqrt2);
  static const std::array<double, n> coefficient = [&] {
    std::array<double, n> a{};
    for (int k = -m + 1; k < m; ++k) {
      const double angle = k * pi / m, t = length * std::tan(angle / 2);
      const double f = std::exp(-t * t) * (length * length + t * t);
      for (int order = 0; order < n; ++order) a[order] += f * std::cos((order + 1) * angle) / (2 * m);
    }
    return a;
  }();
  const Complex iz{-z.imag(), z.real()};
  const Complex ratio = (length + iz) / (length - iz);
  Complex p = 0;
  for (int order = n; order-- > 0;) p = p * ratio + coefficient[order];
  return 2.0 * p / ((length - iz) * (length - iz)) + 1 / std::sqrt(pi) / (length - iz);
}

}  // namespace

std::complex<double> scaled_erfc(std::complex<double> z) {
  if (z.real() < 0) return 2.0 * std::exp(z * z) - scaled_erfc(-z);
  return faddeeva({-z.imag(), z.real()});
}

std::complex<double> bessel_product(int n, std::complex<double> x) {
  const Complex y = 1.0 / (2.0 * x);
  double a = 1;  // (n+k)!/(k! (n−k)!)
  Complex up = 1, down = 1, power = 1;
  for (int k = 1; k <= n; ++k) {
    a *= static_cast<double>((n + k) * (n - k + 1)) / k;
    power *= y;
    up += a * power;
    down += (k % 2 == 0 ? a : -a) * power;
  }
  const double sign = n % 2 == 0 ? 1 : -1;
  return (2.0 * n + 1) * y * (down * up - sign * std::exp(-2.0 * x) * up * up);
}

double inviscid_frequency(int n, double radius, const WaveMaterials& of) {
  return std::sqrt(n * (n + 1.0) * (n - 1) * (n + 2) * of.film_tension /
                   ((2 * n + 1) * of.density * std::pow(radius, 3)));
}

Decay bubble_mode(int n, double radius, const WaveMaterials& of) {
  expects(n >= 2, "modes of a bubble begin with n = 2");
  const double omega_0 = inviscid_frequency(n, radius, of), nu = of.viscosity / of.density;
  const double gamma = (2 * n + 1) * std::sqrt(nu * omega_0) / (4 * std::numbers::sqrt2 * radius);
  return decay(newton(
      [&](Complex s) {
        return s * s + omega_0 * omega_0 * (1.0 - bessel_product(n, radius * std::sqrt(s / nu)));
      },
      {-gamma, omega_0 - gamma}));
}

Decay planar_mode(double k, const WaveMaterials& of) {
  const double nu = of.viscosity / of.density;
  const double omega_0 = std::sqrt(of.film_tension * k * k * k / (2 * of.density));
  const double gamma = k * std::sqrt(nu * omega_0) / (2 * std::numbers::sqrt2);
  return decay(
      newton([&](Complex s) { return s * s + omega_0 * omega_0 * (1.0 - k / std::sqrt(k * k + s / nu)); },
             {-gamma, omega_0 - gamma}));
}

PlanarWave::PlanarWave(double k, const WaveMaterials& of)
    : q_(k * std::sqrt(of.viscosity / of.density)),
      omega_0_(std::sqrt(of.film_tension * k * k * k / (2 * of.density))) {
  root_ = quartic_roots({omega_0_ * omega_0_, -q_ * q_ * q_, -q_ * q_, q_});
  for (const Complex& z : root_) {
    const Complex slope = ((4.0 * z + 3 * q_) * z - 2 * q_ * q_) * z - q_ * q_ * q_;
    residue_.push_back(z * (z + q_) / slope);
  }
}

double PlanarWave::amplitude(double t) const {
  Complex sum = 0;
  for (std::size_t i = 0; i < root_.size(); ++i)
    sum += residue_[i] * root_[i] * scaled_erfc(-root_[i] * std::sqrt(t));
  return std::exp(-q_ * q_ * t) * sum.real();
}

}  // namespace spume::verification
