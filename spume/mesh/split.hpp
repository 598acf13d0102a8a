#pragma once

#include "spume/mesh/remesh.hpp"
#include "spume/mesh/working_mesh.hpp"

namespace spume::mesh {

/// One pass over the edges longer than `split_above` × target, longest first: each is cut in half together
/// with all its triangles (two in a film, three at a border), unless one of them was cut in this pass
/// already. Edges between two vertices of a cut stay, for they are another part's as well, and those of more
/// than three triangles; and so does each edge in a triangle with a longer one that stays. The new vertex is
/// the projection of the middle with the phases of the edge, or the middle itself where there is none. Gives
/// the number of edges cut; call again while it is positive.
int split_long_edges(WorkingMesh& work, const TargetLength& target, const Projection& project,
                     double split_above);

}  // namespace spume::mesh
