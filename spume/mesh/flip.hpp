#pragma once

#include "spume/mesh/working_mesh.hpp"

namespace spume::mesh {

/// Flips edges inside a lamella whose two opposite angles exceed π together (by 0.05, so that squares stay),
/// towards the Delaunay triangulation, in up to three rounds. An edge stays when a triangle would turn by
/// more than 60 degrees, when the new edge exists already, or when it would join two points of borders across
/// the film. Gives the number of flips.
int flip_edges(WorkingMesh& work);

}  // namespace spume::mesh
