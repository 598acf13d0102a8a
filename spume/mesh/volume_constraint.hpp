#pragma once

#include <span>

#include "spume/mesh/film_mesh.hpp"

namespace spume::mesh {

/// Moves the vertices along the film normals so that each phase p ≥ 1 has volume target[p] (entries ≤ 0 are
/// ignored): displacement c_a − c_b along the normal of each film, with one constant c a phase from a graph
/// Laplacian of film areas; least squares where films meet. `iterations` Newton steps; three reach 1e-9
/// relative. No vertex moves by more than `largest_step` [m] an iteration. Gives the largest displacement
/// [m].
double restore_volumes(FilmMesh& mesh, std::span<const double> target, int iterations, double largest_step);

}  // namespace spume::mesh
