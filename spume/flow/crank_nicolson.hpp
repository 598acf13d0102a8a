#pragma once

#include "spume/flow/block.hpp"
#include "spume/grid/elliptic.hpp"
#include "spume/state/materials.hpp"

namespace spume::flow {

/// What accelerates the gas besides its own advection, at the old time level:
///   a = (f − ∇p^{n−½})/ρ + ν ∇²uⁿ [m/s²],
/// ∇p by wide_difference(), ∇² the seven-point Laplacian. One component, of the owned cells and one layer
/// around them; `u` and `body_force` are of that component.
void explicit_acceleration(const grid::Grid& grid, const state::Gas& gas, int component,
                           const GhostedField& u, const GhostedField& pressure,
                           const GhostedField& body_force, BlockArray& acceleration);

/// The implicit half of the Crank–Nicolson scheme. With the viscous term of uⁿ already in the rate r on
/// entry,
///   (u* − uⁿ)/Δt = r + ½ν ∇²(u* − uⁿ),
/// so the rate on exit solves (1 − ½νΔt ∇²) x = r, one Helmholtz problem a component. Collective.
void diffuse_implicitly(grid::EllipticSolver& elliptic, const state::Gas& gas, double dt,
                        grid::VectorField& rate);

}  // namespace spume::flow
