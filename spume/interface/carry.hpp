#pragma once

#include "spume/grid/field.hpp"
#include "spume/grid/kernel_coupling.hpp"
#include "spume/mesh/film_mesh.hpp"

namespace spume::interface {

/// Moves the vertices with the gas for dt [s]: mid-point rule in space, velocity u^{n+1} sampled with the
/// kernel that spreads the forces, and lying where that kernel takes it. Collective.
void carry(mesh::FilmMesh& films, const grid::VectorField& velocity, const grid::KernelCoupling& kernel,
           double dt);

}  // namespace spume::interface
