#include "spume/verification/bubble_wave.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

#include "tests/unit/verification/half_period.hpp"

namespace spume::verification {
namespace {

TEST(MixedBesselProduct, AgreesWithTheFunctionsOfTheStandardLibraryOnTheRealAxis) {
  for (int n = 1; n <= 5; ++n)
    for (const double x : {2.0, 5.0, 20.0}) {
      const double exact = (2 * n + 1) * x * std::cyl_bessel_i(n - 0.5, x) * std::cyl_bessel_k(n + 0.5, x);
      EXPECT_NEAR(mixed_bessel_product(n, x).real() / exact, 1, 1e-9) << n << " " << x;
    }
}

TEST(BubbleWave, StartsFromRest) {
  const WaveMaterials of{1, 0.01, 1};
  const BubbleWave wave(2, 1, of);
  const double t = 1e-3 / inviscid_frequency(2, 1, of);
  EXPECT_NEAR(wave.amplitude(t), 1 - 0.5e-6, 1e-7);
  EXPECT_NEAR(wave.stretch(t), -0.75e-6, 1e-7);
}

TEST(BubbleWave, WithoutViscosityStretchesTheFilmByThreeHalvesOfItsMotion) {
  for (const int n : {2, 5}) {
    const BubbleWave wave(n, 2, {1, 1e-10, 1});
    for (const double phase : {0.5, 2.0, 6.0}) {
      const double t = phase / inviscid_frequency(n, 2, {1, 0, 1});
      EXPECT_NEAR(wave.stretch(t), 1.5 * (wave.amplitude(t) - 1), 1e-3) << n << " " << phase;
    }
  }
}

// Zeros of the amplitude, late enough for the memory of the start to be small, are half a period apart.
TEST(BubbleWave, RingsDownAsTheNormalMode) {
  const WaveMaterials of{1, 0.01, 1};
  const BubbleWave wave(2, 1, of);
  const Decay mode = bubble_mode(2, 1, of);
  EXPECT_NEAR(half_period(wave, mode.omega) * mode.omega / std::numbers::pi, 1, 0.01);
}

/// Stretch and amplitude of mode n at time t for ρ = T = R = a0 = 1 by finite differences of w = r u_r,
///   ∂w/∂t = ν (w'' + 2w'/r − n(n+1) w/r²) + n(n+1)/(2n+1) f g(r),   g = rⁿ inside, r^(−n−1) outside,
/// f = −(n−1)(n+2) a, a' = w(1), e' = −∂u_r/∂r = w(1) − w'(1).
struct FiniteDifferences {
  double amplitude = 1, stretch = 0;

  FiniteDifferences(int n, double viscosity, double t, int points_per_radius) {
    const double dr = 1.0 / points_per_radius, modes = n * (n + 1.0);
    const int at_film = points_per_radius, n_points = 8 * points_per_radius;
    const int n_steps = static_cast<int>(std::ceil(t * viscosity / (0.1 * dr * dr)));
    const double dt = t / n_steps;
    std::vector<double> w(n_points, 0.0), rate(n_points, 0.0);
    for (int step = 0; step < n_steps; ++step) {
      const double force = -(n - 1) * (n + 2.0) * amplitude;
      for (int i = 1; i + 1 < n_points; ++i) {
        const double r = i * dr;
        rate[i] = viscosity * ((w[i + 1] - 2 * w[i] + w[i - 1]) / (dr * dr) +
                               (w[i + 1] - w[i - 1]) / (r * dr) - modes * w[i] / (r * r)) +
                  modes / (2 * n + 1) * force * (i <= at_film ? std::pow(r, n) : std::pow(r, -n - 1));
      }
      for (int i = 1; i + 1 < n_points; ++i) w[i] += dt * rate[i];
      amplitude += dt * w[at_film];
      stretch += dt * (w[at_film] - (w[at_film + 1] - w[at_film - 1]) / (2 * dr));
    }
  }
};

TEST(BubbleWave, AgreesWithFiniteDifferencesOfTheRadialProblem) {
  const double viscosity = 0.05;
  for (const int n : {2, 3})
    for (const double t : {0.6, 2.5}) {
      const BubbleWave wave(n, 1, {1, viscosity, 1});
      const FiniteDifferences reference(n, viscosity, t, 50);
      // Steps of 8e-4 in time are first order, which leaves up to 2e-3.
      EXPECT_NEAR(wave.amplitude(t), reference.amplitude, 3e-3) << n << " " << t;
      EXPECT_NEAR(wave.stretch(t), reference.stretch, 3e-3) << n << " " << t;
    }
}

TEST(BubbleWave, StretchesAsItsOwnMotionAsks) {
  const BubbleWave wave(2, 1, {1, 0.05, 1});
  const int n = 200;
  const double t = 2.5, dt = t / n;
  double sum = 0, before = 1;
  for (int i = 1; i <= n; ++i) {
    const double now = wave.amplitude(i * dt);
    sum += wave.response(t - (i - 0.5) * dt) * (now - before);
    before = now;
  }
  // The mid-point rule, of order 3/2 where the response starts like sqrt(t).
  EXPECT_NEAR(sum, wave.stretch(t), 1e-3);
  EXPECT_NEAR(wave.response(1e-6), 1.5, 1e-2);
}

}  // namespace
}  // namespace spume::verification
