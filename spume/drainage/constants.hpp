#pragma once

#include <cmath>
#include <numbers>

namespace spume::drainage {

/// Cross-section of a Plateau border whose three faces are tangent arcs of radius r: λ = (√3 − π/2) r².
inline constexpr double border_shape = std::numbers::sqrt3 - std::numbers::pi / 2;

/// C_Δ: the flux through a border between rigid faces is C_Δ λ²/μ times the pressure gradient. It is ∫w dA/λ²
/// of −Δw = 1 in the cross-section, w = 0 on the arcs: ∫w dA = 5.226269e-4 r⁴ by a spectral solution in polar
/// coordinates.
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
