#pragma once

#include <array>
#include <span>
#include <vector>

#include "spume/state/film_network.hpp"
#include "spume/state/materials.hpp"

namespace spume::drainage {

/// One edge of the border network, from the first to the second unknown.
struct BorderLink {
  std::array<int, 2> unknown;
  double length;   ///< h [m]
  double descent;  ///< g·(x₁ − x₀) [m²/s²]: positive where gravity pulls along the edge
};

/// All Plateau borders as one network of λ.
struct BorderNetwork {
  std::vector<int> vertex;             ///< of each unknown
  std::vector<int> unknown_of_vertex;  ///< −1 off the borders
  std::vector<double> length;          ///< m^b: half of the border edges at the vertex [m]
  std::vector<BorderLink> link;

  int size() const { return static_cast<int>(vertex.size()); }
};

/// The unknowns of the borders: one λ per border vertex, and one per junction, shared by all borders there.
/// Paper: Sec. 2.3.2, Eq. (6).
///   λ₁ = λ₂ = λ₃ = λ₄ holds because they are one unknown. Σ fluxes = 0 is its balance, with the storage of
///   the four half edges around it, which vanishes with the edge length.
/// Throws NumericalError, with the place, where an edge has no length.
BorderNetwork build_border_network(const state::FilmNetwork& network, const Vec3& gravity);

/// λ^{1/2} [m] and λ^{−1/2} [1/m] of one unknown: all that the fluxes along its edges ask of it.
struct BorderRoot {
  double root, inverse;
};
BorderRoot border_root(double lambda);
/// Of all unknowns.
void evaluate_border_roots(std::span<const double> lambda, std::vector<BorderRoot>& result);

/// Flux along a border edge from its unknown 0 to its unknown 1, and its derivatives by λ₀ and λ₁.
struct BorderFlux {
  double value;                 ///< [m³/s]
  std::array<double, 2> slope;  ///< [m/s]
};

/// Flow along one border edge between cross-sections a = λ₀ and b = λ₁, driven by the pressure
/// −2 C₁ λ^{−1/2} and by gravity. It is exactly zero where λ^{−1/2} is hydrostatic.
/// Paper: Sec. 2.3.2, Eq. (5).
///   F = (C_Δ/μ) √(ab) (a + √(ab) + b)/3 · [2 C₁ (b^{−1/2} − a^{−1/2}) + ρ g·(x₁ − x₀)]/h
/// with C₁ = ½ σ (√3 − π/2)^{1/2}; it approximates (C_Δ/μ)(−C₁ λ^{1/2} ∂λ/∂ℓ + λ² ρ g_τ). The mean of λ² is
/// the one with which the capillary part, −C₁ (2/3)(b^{3/2} − a^{3/2})/h, is the integral of λ^{1/2} ∂λ/∂ℓ
/// exactly, however much λ varies along the edge; and it vanishes with either end.
///   Tension adds 2 C₁ (C_Δ/3μh)(a^{3/2} − b^{3/2}) to F, and to the slopes C₁ (C_Δ/μh) a^{1/2} and
/// −C₁ (C_Δ/μh) b^{1/2}: they are written so, for in the product of mobility and drive digits cancel where
/// the ends differ much.
BorderFlux border_flux(const BorderRoot& a, const BorderRoot& b, const BorderLink& link,
                       const state::Materials& materials);

/// Adds to each unknown what flows in along its edges [m³/s].
void add_border_flow(const BorderNetwork& borders, std::span<const BorderRoot> root,
                     const state::Materials& materials, std::span<double> rate);

/// The same, and the slopes of the flux along each edge [m/s].
void linearise_border_flow(const BorderNetwork& borders, std::span<const BorderRoot> root,
                           const state::Materials& materials, std::span<double> rate,
                           std::span<std::array<double, 2>> slope);

}  // namespace spume::drainage
