#pragma once

#include <vector>

#include "spume/mesh/film_mesh.hpp"
#include "spume/mesh/topology.hpp"

namespace spume::rupture {

/// A film mesh after two phases became one, and where the old unknowns are.
struct MergedMesh {
  mesh::FilmMesh films;
  mesh::Topology topology;
  std::vector<int> film_dof;    ///< per old film dof: the new one; −1: of a film that is gone
  std::vector<int> border_dof;  ///< per old border dof: the new one; −1: of a border that is gone
  std::vector<int> lamella;     ///< per old lamella: the new one; −1: gone
};

/// Makes phase `gone` part of phase `kept` (paper, Sec. 3.4 step iii): films between the two drop out;
/// borders around them become lines inside a film; lamellae that met there become one, and several old dofs
/// may become one.
MergedMesh merge_phases(const mesh::FilmMesh& films, const mesh::Topology& topology, mesh::Phase kept,
                        mesh::Phase gone);

}  // namespace spume::rupture
