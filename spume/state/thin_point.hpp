#pragma once

#include "spume/mesh/topology.hpp"

namespace spume::state {

/// Where a network is thinnest, as a rupture criterion sees it.
struct ThinPoint {
  int film_dof = -1;  ///< −1: no point counts (all lamellae protected)
  int lamella = -1;
  double half_thickness = 0;  ///< η [m]
  mesh::VertexKind kind = mesh::VertexKind::Film;
};

}  // namespace spume::state
