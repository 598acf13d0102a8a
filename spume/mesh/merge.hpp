#pragma once

#include "spume/mesh/remesh.hpp"
#include "spume/mesh/working_mesh.hpp"

namespace spume::mesh {

/// Draws each group of vertices that edges shorter than merge_below × target join into one point: borders
/// between two junctions, and films smaller than a cell, which collapse_short_edges() must keep because what
/// the foam is made of changes with them. The point is a junction where five, six or more phases meet, the
/// intermediate state of a T1: a foam that moves on is split again by its reconstruction, one way or the
/// other. A group is drawn together only if
///  - every edge at the new vertex is inside one lamella or on a border;
///  - the link of the new vertex is a sphere divided among the phases of the group, each one region of it
///    (V − E + F = 2 with F their number): no phase touches itself, none vanishes, no hole closes;
///  - the group is small: at most twelve vertices within half a target length of the first;
///  - no triangle turns over that was not a sliver.
/// Where a whole group cannot, its edges are tried one by one, shortest first. The new vertex is at the mean
/// of those of highest precedence. Gives the number of vertices that went.
int merge_tiny_features(WorkingMesh& work, const TargetLength& target, const RemeshParameters& parameters);

}  // namespace spume::mesh
