#pragma once

#include "spume/mesh/film_mesh.hpp"
#include "spume/mesh/topology.hpp"

namespace spume::mesh {

struct Quality {
  double smallest_angle_degrees;
  double median_angle_degrees;  ///< of the smallest angles of the triangles
  double shortest_edge;         ///< [m]
  double longest_edge;          ///< [m]
  int n_inverted;  ///< triangles whose normal opposes the mean normal of their lamella around their corners
};

Quality measure_quality(const FilmMesh& mesh, const Topology& topology);

}  // namespace spume::mesh
