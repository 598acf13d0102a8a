#pragma once

#include "spume/mesh/remesh.hpp"
#include "spume/mesh/working_mesh.hpp"

namespace spume::mesh {

/// One sweep: film vertices go 0.7 of the way to the area-weighted mean of the centroids of their triangles,
/// border vertices to the length-weighted mean of the middles of their border edges, all at once; junctions
/// stay. Each is then projected back; where there is no projection it stays where it was.
void smooth(WorkingMesh& work, const Projection& project);

}  // namespace spume::mesh
