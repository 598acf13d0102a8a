#pragma once

#include <span>
#include <vector>

#include "spume/grid/field.hpp"
#include "spume/grid/kernel_coupling.hpp"
#include "spume/viim/closest_points.hpp"
#include "spume/viim/distance_field.hpp"

namespace spume::viim {

/// The extension velocity of the cells around the films: that of the gas at their closest point, sampled with
/// the kernel that spreads the forces [m/s]. It is constant along normals, so φ stays a distance. Collective;
/// the same on every rank. Shape: as `band`.
std::vector<Vec3> extension_velocity(std::span<const ClosestPoint> band, const grid::VectorField& velocity,
                                     const grid::KernelCoupling& kernel);

/// Advances φ of the cells of `band` by dt [s] under φ_t + u·∇φ = 0, `u` [m/s] as of extension_velocity().
/// Paper: Sec. 2.1.1, Eq. (1); Sec. 3.1.
///
/// Upwind differences of fifth order that avoid creases (WENO: Jiang and Peng, SIAM J. Sci. Comput. 21 (2000)
/// 2126), of the signed function of the cell's own phase, so that no stencil sees φ turn up again behind a
/// film; the TVD Runge–Kutta method of third order in time (Heun's is unstable with these differences).
/// Stable for Courant numbers Σ|u_d| Δt/h up to 1.
void advance(DistanceField& field, std::span<const ClosestPoint> band, std::span<const Vec3> velocity,
             double dt);

}  // namespace spume::viim
