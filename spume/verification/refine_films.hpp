#pragma once

#include <functional>
#include <span>

#include "spume/mesh/film_mesh.hpp"
#include "spume/mesh/topology.hpp"

namespace spume::verification {

/// The point of a film, or of a Plateau border, halfway between two of it; `phases` meet there.
using Middle = std::function<Vec3(const Vec3& a, const Vec3& b, const mesh::PhaseSet& phases)>;

/// On a straight line.
inline Vec3 straight_middle(const Vec3& a, const Vec3& b, const mesh::PhaseSet& /*phases*/) {
  return 0.5 * (a + b);
}

/// Cuts the marked triangles in four by the middles of their edges, and so all that would share two such
/// middles or more; those that share one are cut in two. So a triangle that fills the corner of a film leaves
/// a smaller one of the same shape there, and no edge runs into the corner.
/// Takes: one mark per triangle. The mesh is not periodic.
mesh::FilmMesh refine(const mesh::FilmMesh& mesh, std::span<const char> marked, const Middle& middle);

/// Refines what lies within `layers` triangles of the vertices of this kind or of a higher one (film < border
/// < junction); all of the mesh for VertexKind::Film.
mesh::FilmMesh refine_around(const mesh::FilmMesh& mesh, mesh::VertexKind kind, int layers,
                             const Middle& middle);

}  // namespace spume::verification
