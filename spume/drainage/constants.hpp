#pragma once

#include <cmath>
#include <numbers>

namespace spume::drainage {

/// Cross-section of a Plateau border whose three faces are tangent arcs of radius r: λ = (√3 − π/2) r².
inline constexpr double border_shape = std::numbers::sqrt3 - std::numbers::pi / 2;

/// C_Δ of the paper's Eqs. (5), (12), (15), which does not give it: a border with rigid faces and a pressure
/// gradient G carries the flux (C_Δ/μ) λ² G of Stokes flow. With −Δw = 1 in the cross-section and w = 0 on
/// its three arcs, C_Δ = ∫w dA/λ². Source: ∫w dA = 5.226269365e-4 r⁴ by a spectral Galerkin method in polar
/// coordinates about the centre of an arc, ten digits converged: C_Δ = 0.02009871 = 1/49.7544
/// (tests/unit/drainage/border_flow_test.cpp recomputes it). The paper's Tables 3 and 4 were made with
/// 0.0201.
inline constexpr double border_flow = 0.0200987;

/// C₁ = ½ σ (√3 − π/2)^{1/2} [N/m]. The pressure in a border is −2 C₁ λ^{−1/2} below that of the gas.
inline double border_tension(double surface_tension) {
  return 0.5 * surface_tension * std::sqrt(border_shape);
}

/// Added to η and λ where a relative error is asked for: 0.2 nm is a molecule, 1 µm² a border of 2.5 µm
/// radius, far below what the equations hold for; nothing thinner needs a relative accuracy of its own.
inline constexpr double half_thickness_floor = 0.2e-9;  // [m]
inline constexpr double border_area_floor = 1e-12;      // [m²]

}  // namespace spume::drainage
