#pragma once

#include <complex>

#include "spume/verification/exact_waves.hpp"

namespace spume::verification {

/// Mode n ≥ 2 of a bubble of radius R that starts from rest in gas without end, to first order in its
/// amplitude a: the film is at r = R + a(t) P_n(cos θ), and its area at a point is 1 + e(t) P_n(cos θ) times
/// that at the start. A film that starts with η0 everywhere has η = η0 (1 − e P_n).
///
/// With P = (2n+1) I_{n+½} K_{n+½} and X = (2n+1) x I_{n−½} K_{n+½} at x = R sqrt(sρ/μ) the transforms are,
/// over a0 and a0/R (derivation: docs/liquid_transport.md),
///   â = s/(s² + ω0² (1 − P)),   ê = −ω0² (1 − n − (n+2) P + X)/(s (s² + ω0² (1 − P))).
/// Without viscosity e = 3/2 (a − a0)/R; with it e does not come back to zero with a.
class BubbleWave {
 public:
  BubbleWave(int n, double radius, const WaveMaterials& of);
  /// a(t)/a0. For 0 < t < 20/ω0: to 1e-7.
  double amplitude(double t) const;
  /// e(t) R/a0. The same.
  double stretch(double t) const;
  /// e R at a time t > 0 after the amplitude has been changed by one at once, whatever moved it: e R = ∫
  /// response(t − τ) da(τ), of the transform (1 − n − (n+2) P + X)/(s (1 − P)). 3/2 at first.
  double response(double t) const;

 private:
  int n_;
  double viscous_time_;  ///< R²/ν [s]
  double omega_0_;       ///< [1/s]
};

/// (2n+1) x I_{n−½}(x) K_{n+½}(x) for n ≥ 1, by the finite sums of half-integer orders; loses digits where
/// |x| is below n.
std::complex<double> mixed_bessel_product(int n, std::complex<double> x);

}  // namespace spume::verification
