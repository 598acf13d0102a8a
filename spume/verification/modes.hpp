#pragma once

#include <span>

#include "spume/mesh/film_mesh.hpp"
#include "spume/verification/exact_waves.hpp"

namespace spume::verification {

/// Amplitude a_n [m] of the Legendre mode of a bubble about the z axis: r = Σ a_n P_n(cos θ) as seen from the
/// centroid of its volume, (2n+1)/2 ∫ r P_n d cos θ over its films. The bubble must be star-shaped.
double mode_amplitude(const mesh::FilmMesh& films, mesh::Phase bubble, int n);

/// The centroid of the volume of a bubble [m].
Vec3 centroid(const mesh::FilmMesh& films, mesh::Phase bubble);

/// The ω and γ of exp(−γt)(A cos ωt + B sin ωt) + C that fit the samples best by least squares: Gauss and
/// Newton from `guess`, with A, B and C solved for exactly. Throws NumericalError when it does not converge.
Decay fit_damped_cosine(std::span<const double> time, std::span<const double> value, const Decay& guess);

}  // namespace spume::verification
