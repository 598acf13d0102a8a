#pragma once

#include <vector>

#include "spume/mesh/film_mesh.hpp"
#include "spume/mesh/topology.hpp"

namespace spume::flow {

/// Takes out of vertex forces [N] what pulls along the films: at vertices inside a film all but what is
/// normal to the film, on a border what is along the border. At junctions, where borders touch, and where a
/// border turns back on itself all counts. Each connected piece of the films keeps the sum of its forces, and
/// their moment about the axes around which it is bounded (in a periodic box it may run into its own image).
/// For that every vertex gets
///   A_v (P_v + ε)(a + b × x_v),
/// A_v the area at it, P_v what counts, ε = 10⁻³, a and b of the piece. So forces stay normal to films, but
/// where a motion of the whole piece is none but sliding: of a film of revolution about its axis, of a film
/// through the whole box along itself.
void take_out_sliding(const mesh::FilmMesh& films, const mesh::Topology& topology, std::vector<Vec3>& force);

}  // namespace spume::flow
