#pragma once

#include <vector>

#include "spume/mesh/film_mesh.hpp"
#include "spume/mesh/topology.hpp"
#include "spume/transport/grouping.hpp"
#include "spume/transport/point_bins.hpp"

namespace spume::transport {

/// A film mesh with what the rules of transport ask of it again and again. Keeps references to mesh and
/// topology.
struct LiquidMesh {
  const mesh::FilmMesh& films;
  const mesh::Topology& topology;

  std::vector<double> dof_area;       ///< lumped, per film dof [m²]
  std::vector<double> lamella_area;   ///< [m²]
  std::vector<double> dof_length;     ///< lumped, per border dof [m]
  std::vector<double> border_length;  ///< [m]

  std::vector<int> lamella_of_dof, border_of_dof;
  Grouping dofs_of_lamella, dofs_of_border;
  Grouping edges_of_lamella;  ///< border edges that lie on the rim of each lamella

  PointBins film_bins, border_bins;  ///< of the dofs' vertices

  const Vec3& film_position(int dof) const { return films.position[topology.film_dof[dof].vertex]; }
  const Vec3& border_position(int dof) const { return films.position[topology.border_dof[dof].vertex]; }
};

/// Measures a mesh; `h` [m] is the size of the bins.
LiquidMesh measure_liquid_mesh(const mesh::FilmMesh& films, const mesh::Topology& topology, double h);

}  // namespace spume::transport
