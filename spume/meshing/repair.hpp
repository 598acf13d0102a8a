#pragma once

#include <span>

#include "spume/mesh/remesh.hpp"
#include "spume/meshing/star_mesh.hpp"

namespace spume::meshing {

struct RepairReport {
  int n_moved = 0, n_flipped = 0, n_collapsed = 0, n_absorbed = 0;
  int n_left = 0;  ///< triangles with an angle below the wanted one
};

/// Changes the mesh around every triangle with an angle below `wanted_degrees`, the worst first, by the first
/// of these that makes the worst triangle there better, and again until nothing helps:
///  - an edge inside a film is flipped;
///  - a vertex moves within its film or along its border, to the best of places tried around it;
///  - an edge collapses, with the precedence junction > border > film and the link condition of
///    mesh/collapse.hpp, if no edge gets longer than 1.8 × target;
///  - a film vertex that lies too near a border edge becomes a vertex of that border.
/// What the films, borders and junctions are does not change. `target` holds wanted edge lengths at vertices
/// [m].
RepairReport repair(StarMesh& star_mesh, const mesh::Projection& project, std::span<const double> target,
                    double wanted_degrees);

/// Flips edges that run from a junction to the inside of a film between two triangles alone, so that one
/// triangle fills the corner of the film, where that leaves no angle below 24 degrees. The vertex of a corner
/// then has no link into its film, as drainage wants it. Gives the number of flips.
int fill_corners(StarMesh& star_mesh, const mesh::Projection& project);

}  // namespace spume::meshing
