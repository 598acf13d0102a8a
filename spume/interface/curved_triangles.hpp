#pragma once

#include <array>
#include <vector>

#include "spume/mesh/film_mesh.hpp"
#include "spume/mesh/topology.hpp"

namespace spume::interface {

/// Midpoints of the sides of a triangle on the curved film: midpoint[e] between vertices e and e + 1 (mod 3).
using EdgeMidpoints = std::array<Vec3, 3>;

/// Midpoints of all edges, so that each triangle may be replaced by four that follow the film to third order
/// in its size; flat triangles are inscribed in a curved film and would act like curvature flow. Shape: one
/// entry a triangle [m].
///   film edge a–b:   (a + b)/2 + ((n_b − n_a)·(b − a)/8) n,  n_a, n_b unit normals of that lamella, n their
///   direction; border edge a–b: (a + b)/2 + (ℓ/8)(t_a − t_b),          t unit tangents of the border
///   (one-sided at junctions).
/// Both are cubic Hermite arcs at their middle. Displacements are clipped to 0.15 ℓ. Neighbours get the same
/// point.
std::vector<EdgeMidpoints> edge_midpoints(const mesh::FilmMesh& films, const mesh::Topology& topology);

}  // namespace spume::interface
