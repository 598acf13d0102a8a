#include "spume/verification/exact_waves.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <numbers>

#include "tests/unit/verification/half_period.hpp"

namespace spume::verification {
namespace {

using Complex = std::complex<double>;
using std::numbers::pi;

TEST(BesselProduct, agrees_with_the_functions_of_the_standard_library_on_the_real_axis) {
  for (int n = 0; n <= 5; ++n)
    for (const double x : {2.0, 5.0, 20.0}) {
      const double exact = (2 * n + 1) * std::cyl_bessel_i(n + 0.5, x) * std::cyl_bessel_k(n + 0.5, x);
      EXPECT_NEAR(bessel_product(n, x).real() / exact, 1, 1e-9) << n << " " << x;
    }
}

// Tabulated by a separate root search with arbitrary-precision Bessel functions.
TEST(BubbleMode, has_the_tabulated_frequencies_and_decays) {
  struct {
    double mu, omega, gamma;
  } const table[] = {{0.001, 2.14952, 0.0429331},
                     {0.005, 2.09832, 0.100313},
                     {0.01, 2.05984, 0.146441},
                     {0.02, 2.00501, 0.216331},
                     {0.05, 1.89297, 0.372724}};
  for (const auto& row : table) {
    const Decay d = bubble_mode(2, 1, {1, row.mu, 1});
    EXPECT_NEAR(d.omega, row.omega, 1e-5);
    EXPECT_NEAR(d.gamma, row.gamma, 1e-6);
  }
}

TEST(BubbleMode, tends_to_the_inviscid_law_with_the_square_root_of_viscosity) {
  const auto shift = [](double mu) {
    return inviscid_frequency(3, 1, {1, mu, 1}) - bubble_mode(3, 1, {1, mu, 1}).omega;
  };
  EXPECT_NEAR(std::log2(shift(4e-6) / shift(1e-6)), 1, 0.02);
}

// A wave of short length on a large bubble is a wave on a flat film with k = n/R, to O(1/n).
TEST(PlanarMode, is_the_limit_of_short_waves_on_a_bubble) {
  const double mu = 1e-4, n = 40;
  const Decay curved = bubble_mode(static_cast<int>(n), 1, {1, mu, 1}),
              flat = planar_mode(n + 0.5, {1, mu, 1});
  EXPECT_NEAR(curved.omega / flat.omega, 1, 0.002);
  EXPECT_NEAR(curved.gamma / flat.gamma, 1, 0.01);
}

TEST(ScaledErfc, agrees_with_the_real_function_and_mirrors) {
  for (const double x : {-2.0, -0.3, 0.0, 0.5, 1.0, 3.0, 5.0})
    EXPECT_NEAR(scaled_erfc(x).real() / (std::exp(x * x) * std::erfc(x)), 1, 1e-11) << x;
  // erfcx(z) for large |z| is 1/(√π z) (1 − 1/(2z²) + 3/(4z⁴) − …).
  const Complex z{20, 30};
  const Complex series = (1.0 - 1.0 / (2.0 * z * z) + 3.0 / (4.0 * z * z * z * z)) / (std::sqrt(pi) * z);
  EXPECT_NEAR(std::abs(scaled_erfc(z) / series - 1.0), 0, 1e-8);
  EXPECT_NEAR(std::abs(scaled_erfc(std::conj(z)) - std::conj(scaled_erfc(z))), 0, 1e-15);
}

/// Numerical inverse Laplace transform along Talbot's contour with 40 points.
double inverse_laplace(const std::function<Complex(Complex)>& f, double t) {
  const int n = 40;
  const double r = 2.0 * n / (5 * t);
  double sum = 0.5 * std::exp(r * t) * f(r).real();
  for (int k = 1; k < n; ++k) {
    const double a = k * pi / n, cot = 1 / std::tan(a);
    const Complex s{r * a * cot, r * a};
    const Complex weight{1, a + (a * cot - 1) * cot};
    sum += (std::exp(s * t) * f(s) * weight).real();
  }
  return r / n * sum;
}

TEST(PlanarWave, is_the_inverse_of_its_transform) {
  const double k = 2 * pi, mu = 0.02;
  const WaveMaterials of{1, mu, 1};
  const PlanarWave wave(k, of);
  const double w2 = wave.omega_0() * wave.omega_0();
  const auto transform = [&](Complex s) { return s / (s * s + w2 * (1.0 - k / std::sqrt(k * k + s / mu))); };
  // Talbot's contour stays right of the poles for a few periods.
  for (const double phase : {0.1, 1.0, 3.0, 6.0}) {
    const double t = phase / wave.omega_0();
    EXPECT_NEAR(wave.amplitude(t), inverse_laplace(transform, t), 1e-6) << phase;
  }
}

TEST(PlanarWave, starts_at_rest_and_rings_down_as_the_normal_mode) {
  const WaveMaterials of{1, 0.01, 1};
  const double k = 2 * pi;
  const PlanarWave wave(k, of);
  EXPECT_NEAR(wave.amplitude(0), 1, 1e-10);
  const double t0 = 1e-3 / wave.omega_0();
  EXPECT_NEAR(wave.amplitude(t0), 1 - 0.5e-6, 1e-7);
  // Zeros of the oscillation, late enough for the memory of the start to be gone, are half a period apart.
  const Decay mode = planar_mode(k, of);
  EXPECT_NEAR(half_period(wave, mode.omega) * mode.omega / pi, 1, 0.01);
}

}  // namespace
}  // namespace spume::verification
