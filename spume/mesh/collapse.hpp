#pragma once

#include "spume/mesh/remesh.hpp"
#include "spume/mesh/working_mesh.hpp"

namespace spume::mesh {

/// Collapses edges shorter than collapse_below × target, and the edges of film vertices with only three
/// triangles, in up to six passes, the later ones around what has changed only. In a pass edges go block by
/// block of vertices with consecutive numbers, in each the shortest first. One end v goes, the other, w,
/// stays where it is:
///  - v is not a junction, its phases are among those of w, and it has no higher precedence;
///  - w is not on a cut, where the link condition could not be told;
///  - a border vertex goes only along a border edge, a film vertex only along a film edge;
///  - the link condition holds (Dey, Edelsbrunner, Guha & Nekhayev, Publ. Inst. Math. 66, 1999), so that what
///  the
///    films, borders and junctions are does not change;
///  - no triangle turns away from the film unless it was worse before, none gets an edge longer than
///    no_edge_beyond × target (nor than split_above × target, when edges are split), and none becomes a
///    sliver unless it was a worse one. The limits are wider for tiny edges.
/// Gives the number of collapses.
int collapse_short_edges(WorkingMesh& work, const TargetLength& target, const RemeshParameters& parameters);

}  // namespace spume::mesh
