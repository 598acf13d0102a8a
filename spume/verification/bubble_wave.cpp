#include "spume/verification/bubble_wave.hpp"

#include <cmath>
#include <numbers>

#include "spume/base/contract.hpp"

namespace spume::verification {

namespace {

using Complex = std::complex<double>;
using std::numbers::pi;

/// Sums of half-integer orders: K_{n+½}(x) = sqrt(π/2x) exp(−x) growing, I_{n+½}(x) = (exp(x) alternating −
/// (−1)ⁿ exp(−x) growing)/sqrt(2πx).
struct HalfIntegerSums {
  Complex growing = 1, alternating = 1;

  HalfIntegerSums(int n, Complex x) {
    double a = 1;  // (n+k)!/(k! (n−k)!)
    Complex power = 1;
    for (int k = 1; k <= n; ++k) {
      a *= static_cast<double>((n + k) * (n - k + 1)) / k;
      power /= 2.0 * x;
      growing += a * power;
      alternating += (k % 2 == 0 ? a : -a) * power;
    }
  }
};

/// Inverse Laplace transform of a function that is real on the real axis, by the mid-point rule on Talbot's
/// cotangent contour with the constants of Trefethen, Weideman and Schmelzer (BIT 46, 653 (2006)). Its
/// singularities must lie within |Im s| < 30/t.
template <class Transform>
double inverse_laplace(Transform&& transform, double t) {
  constexpr int n = 96;
  Complex sum = 0;
  for (int k = 0; k < n; ++k) {
    const double angle = (2 * k + 1 - n) * pi / n, x = 0.6407 * angle;
    const Complex z = static_cast<double>(n) * Complex{0.5017 * angle / std::tan(x) - 0.6122, 0.2645 * angle};
    const Complex slope = static_cast<double>(n) *
                          Complex{0.5017 / std::tan(x) - 0.5017 * x / std::pow(std::sin(x), 2), 0.2645};
    sum += std::exp(z) * transform(z / t) * slope;
  }
  return (sum / Complex{0, n * t}).real();
}

}  // namespace

std::complex<double> mixed_bessel_product(int n, std::complex<double> x) {
  expects(n >= 1, "an order of one at least");
  const HalfIntegerSums below(n - 1, x), at(n, x);
  const double sign = n % 2 == 0 ? -1 : 1;  // (−1)^(n−1)
  return (n + 0.5) * at.growing * (below.alternating - sign * std::exp(-2.0 * x) * below.growing);
}

BubbleWave::BubbleWave(int n, double radius, const WaveMaterials& of)
    : n_(n),
      viscous_time_(radius * radius * of.density / of.viscosity),
      omega_0_(inviscid_frequency(n, radius, of)) {
  expects(n >= 2, "modes of a bubble begin with n = 2");
}

double BubbleWave::amplitude(double t) const {
  return inverse_laplace(
      [this](Complex s) {
        const Complex p = bessel_product(n_, std::sqrt(s * viscous_time_));
        return s / (s * s + omega_0_ * omega_0_ * (1.0 - p));
      },
      t);
}

double BubbleWave::stretch(double t) const {
  return inverse_laplace(
      [this](Complex s) {
        const Complex x = std::sqrt(s * viscous_time_), p = bessel_product(n_, x);
        const double squared = omega_0_ * omega_0_;
        return -squared * (1.0 - n_ - (n_ + 2.0) * p + mixed_bessel_product(n_, x)) /
               (s * (s * s + squared * (1.0 - p)));
      },
      t);
}

double BubbleWave::response(double t) const {
  return inverse_laplace(
      [this](Complex s) {
        const Complex x = std::sqrt(s * viscous_time_), p = bessel_product(n_, x);
        return (1.0 - n_ - (n_ + 2.0) * p + mixed_bessel_product(n_, x)) / (s * (1.0 - p));
      },
      t);
}

}  // namespace spume::verification
