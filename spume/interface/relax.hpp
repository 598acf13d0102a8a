#pragma once

#include "spume/mesh/film_mesh.hpp"
#include "spume/mesh/topology.hpp"
#include "spume/state/phases.hpp"

namespace spume::interface {

struct RelaxStepReport {
  double area_before, area_after;  ///< [m²]
  double virial_error;          ///< |(2/3) A / Σ P_i V_i − 1| with P in units of the film tension; 0 where
                                ///< the identity says nothing, see mesh::stands_free()
  double largest_displacement;  ///< [m]
};

/// One step of implicit, volume-constrained curvature flow of the film mesh, without gas:
///   (M/τ + L) x' = (M/τ) x + Σ_i P_i ∂V_i/∂x,
/// L the cotangent matrix summed over all films, M the lumped area, P_i the film pressures a unit of tension,
/// then volumes restored on the mesh, in so many iterations of mesh::restore_volumes(). `topology` is that of
/// the films, which a step keeps. τ [m²] is the time in units where the film tension over the friction is
/// one.
RelaxStepReport relax_step(mesh::FilmMesh& films, const mesh::VertexTopology& topology,
                           const state::Phases& phases, double tau, int volume_iterations = 2);

/// The same for a time τ in `n_steps` steps, without report and less exactly, for meshes that are nearly
/// there: systems are solved to 1e-4 of the displacements, and volumes, which the pressures keep to first
/// order, are not restored.
void relax_briefly(mesh::FilmMesh& films, const mesh::VertexTopology& topology, int n_phases, double tau,
                   int n_steps);

}  // namespace spume::interface
