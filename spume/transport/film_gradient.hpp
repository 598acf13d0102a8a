#pragma once

#include <span>
#include <vector>

#include "spume/transport/liquid_mesh.hpp"

namespace spume::transport {

/// Gradient of a quantity along the film at every film dof [its unit/m], by least squares over the edges of
/// the lamella at that vertex, weighted 1/|edge|², in the plane of the dof's normal. Zero where the edges do
/// not span the plane.
std::vector<Vec3> film_gradient(const LiquidMesh& mesh, std::span<const double> value);

}  // namespace spume::transport
