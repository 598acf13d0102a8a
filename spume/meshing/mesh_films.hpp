#pragma once

#include <vector>

#include "spume/mesh/film_mesh.hpp"
#include "spume/mesh/quality.hpp"
#include "spume/mesh/remesh.hpp"
#include "spume/mesh/topology.hpp"

namespace spume::meshing {

/// The mesh for drainage (paper, Sec. 3.3.1): nearly equilateral triangles, finer towards Plateau borders.
struct MeshingParameters {
  double edge = 1.0;             ///< target edge in the middle of films [h]
  double edge_at_borders = 0.6;  ///< target edge at Plateau borders [h]
  double grading = 0.3;          ///< growth of the target a unit of distance from the border
  int sweeps = 20;
  double smallest_angle_degrees = 15;  ///< wanted; the report says what was reached
};
struct MeshingReport {
  mesh::Quality after;
  mesh::RemeshReport remesh;
};

/// Improves a film mesh in place. `h` [m] scales the targets.
MeshingReport improve(mesh::FilmMesh& films, const mesh::Projection& project, double h,
                      const MeshingParameters& parameters);

/// k₁² + k₂² at every film dof [1/m²], by a quadric fitted to the lamella's vertices around it.
std::vector<double> curvature_squared(const mesh::FilmMesh& films, const mesh::Topology& topology);

}  // namespace spume::meshing
