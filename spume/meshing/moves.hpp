#pragma once

#include <optional>
#include <span>

#include "spume/mesh/remesh.hpp"
#include "spume/meshing/star_mesh.hpp"

namespace spume::meshing {

/// One sweep over the vertices in their order: each goes where the forces want it (forces.hpp) and back onto
/// its film, border or junction. Its step is halved, up to four times, until no triangle around it gets worse
/// than it may: an angle below 30 degrees must not become smaller, no triangle may turn away from the film.
/// So the step adapts to what room there is, and no sweep inverts an element or lowers the smallest angle of
/// the mesh below 30 degrees. Displacements below 0.02 of the target are left. Gives the number of vertices
/// moved.
int move_vertices(StarMesh& star_mesh, const mesh::Projection& project, std::span<const double> target);

/// Where a vertex belongs: the projection of its place onto its film, border or junction. Where four films or
/// more have no point in common that could be found, or more than four phases meet, the place as near to all
/// films at the vertex as the mean of the projections onto each, repeated, comes. Nothing where the
/// projection gives nothing.
std::optional<Vec3> belonging(const StarMesh& star_mesh, const mesh::Projection& project, int v);

/// Puts the vertices where they belong, where no triangle turns away from the film and
/// no angle falls below `least_degrees` that was not smaller before. Gives the number of vertices that were
/// left where they are.
int project_vertices(StarMesh& star_mesh, const mesh::Projection& project, double least_degrees);

/// The worst badness (star_mesh.hpp) of the triangles around v with v at x.
double badness_around(const StarMesh& star_mesh, int v, const Vec3& x);

}  // namespace spume::meshing
