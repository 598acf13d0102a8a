#pragma once

#include "spume/grid/grid.hpp"
#include "spume/mesh/film_mesh.hpp"
#include "spume/mesh/topology.hpp"

namespace spume::interface {

/// Undoes in advance what the grid does to the place of a flat film in a reconstruction: moves vertices
/// inside films, along their unit normals n, by
///   −Σ_d b(n_d²) sgn(n_d) sin(2π x_d/h) n,
/// x from the lower corner of the box. A film found again from samples at cells lies off by that, whose first
/// part is what is sampled of its shortest waves, and second that a cubic through four cells sees where
/// distances are cut off. b is at most 0.0037 h, for smoothing over 2 h² and the profile's floor of 0.3 (the
/// values of ReconstructParameters); what is left is 0.0008 h for films along the grid. Computed for
/// normals in a plane of the grid by tools/grid_shift.py; see docs/decisions/0002.
void undo_grid_shift(const grid::Grid& grid, const mesh::Topology& topology, mesh::FilmMesh& films);

}  // namespace spume::interface
