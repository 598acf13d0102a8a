#pragma once

#include "spume/mesh/remesh.hpp"
#include "spume/mesh/working_mesh.hpp"

namespace spume::mesh {

/// Edges shorter than `tiny` × target: after remeshing those that could not be collapsed.
inline int n_short_edges(const FilmMesh& mesh, const TargetLength& target,
                         const RemeshParameters& parameters = {}) {
  return static_cast<int>(edges_below(mesh, targets_at_vertices(mesh, target), parameters.tiny).size());
}

}  // namespace spume::mesh
