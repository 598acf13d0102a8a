#pragma once

#include <complex>
#include <vector>

/// Linear waves of a film between equal viscous fluids that pulls along its normal only: the exact viscous
/// laws. A film force f per area on a mode of wave number k drives the film at the speed
/// f k/(2ρ s) (1 − k/l), l = sqrt(k² + s/ν), at the Laplace variable s; the same with the product of Bessel
/// functions on a sphere (separate the radial velocity times the radius, whose forcing is harmonic off the
/// film).
namespace spume::verification {

/// Frequency and decay of exp(−γt) cos ωt.
struct Decay {
  double omega;  ///< ω [1/s]
  double gamma;  ///< γ [1/s]
};

/// Gas and film of a wave.
struct WaveMaterials {
  double density;       ///< ρ of the gas on both sides [kg/m³]
  double viscosity;     ///< μ [Pa s]
  double film_tension;  ///< T = 2σ [N/m]
};

/// Inviscid frequency of mode n of a bubble of radius R in the same gas, n(n+1)(n−1)(n+2) T/((2n+1) ρ R³)
/// under the root (Lamb) [1/s].
double inviscid_frequency(int n, double radius, const WaveMaterials& of);

/// Mode n ≥ 2 of a bubble: the root of s² + ω0² (1 − (2n+1) I_{n+½}(x) K_{n+½}(x)) = 0, x = R sqrt(sρ/μ), by
/// Newton's method from the boundary-layer law. Throws NumericalError when it does not converge.
Decay bubble_mode(int n, double radius, const WaveMaterials& of);

/// Mode of a flat film with wave number k [1/m]: the root of s² + ω0² (1 − k/sqrt(k² + s/ν)) = 0,
/// ω0² = Tk³/(2ρ). Throws NumericalError when it does not converge.
Decay planar_mode(double k, const WaveMaterials& of);

/// Amplitude of a wave on a flat film that starts from rest, over its initial value, for unbounded fluids:
/// the solution of the initial-value problem (Prosperetti, Phys. Fluids 24, 1217 (1981), equal fluids, β =
/// 1/4). With z = sqrt(s + νk²), q = k sqrt(ν), its transform is z (z+q)/(z (z−q)(z+q)² + ω0²), a sum over
/// the four roots of the denominator.
class PlanarWave {
 public:
  PlanarWave(double k, const WaveMaterials& of);
  double amplitude(double t) const;
  /// sqrt(Tk³/(2ρ)) [1/s].
  double omega_0() const { return omega_0_; }

 private:
  double q_, omega_0_;
  std::vector<std::complex<double>> root_, residue_;
};

/// exp(z²) erfc(z) for any complex z, to 1e-12 relative where it does not overflow (Weideman, SIAM J. Numer.
/// Anal. 31, 1497 (1994), 40 terms).
std::complex<double> scaled_erfc(std::complex<double> z);

/// (2n+1) I_{n+½}(x) K_{n+½}(x) by the finite sums of half-integer orders; loses digits where |x| is below n.
std::complex<double> bessel_product(int n, std::complex<double> x);

}  // namespace spume::verification
