#pragma once

#include <optional>

#include "spume/interface/potentials.hpp"
#include "spume/mesh/film_mesh.hpp"
#include "spume/mesh/topology.hpp"

namespace spume::interface {

/// Where the potentials have the junction that a contour of them has at vertex `junction`, by
/// PhasePotentials::project(); nothing where they do not have it within reach.
///
/// The contour is linear between cells and the potentials are smooth. Where four of them are nearly equal
/// along a line, as in the middle of a T1, the two differ in what there is: the contour may have junctions,
/// and slender films between them, that the potentials do not have. Newton's method takes such a junction
/// onto another one or past one, and what lies between them would turn over. It shows by
///  - a long way (0.5 h; hardly any other moves by more than 0.3 h);
///  - the phases about the point following each other in another order than in the mesh;
///  - another phase being larger there, of those that meet at vertices to which the mesh leads from the
///    junction within h.
/// `topology` is that of the films, the vertices of which are where the contour has them.
std::optional<Vec3> project_junction(const PhasePotentials& potentials, const mesh::FilmMesh& films,
                                     const mesh::Topology& topology, int junction);

}  // namespace spume::interface
