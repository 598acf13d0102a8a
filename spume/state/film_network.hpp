#pragma once

#include <vector>

#include "spume/mesh/film_mesh.hpp"
#include "spume/mesh/topology.hpp"

namespace spume::state {

/// Films, borders and junctions at rest, for drainage: a mesh with η and λ.
struct FilmNetwork {
  mesh::FilmMesh mesh;
  mesh::Topology topology;
  std::vector<double> half_thickness;     ///< η per film dof [m]
  std::vector<double> curvature_squared;  ///< k = k₁² + k₂² per film dof [1/m²]
  std::vector<double> border_area;  ///< λ per vertex [m²]; one value at a junction; unused (0) inside films
};

}  // namespace spume::state
