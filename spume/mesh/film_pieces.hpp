#pragma once

#include <array>
#include <vector>

#include "spume/mesh/film_mesh.hpp"
#include "spume/mesh/topology.hpp"

namespace spume::mesh {

/// Connected pieces of the films, each as it lies in space where the box is periodic. Films that share a
/// border are of one piece.
struct FilmPieces {
  int count = 0;
  std::vector<int> of_vertex;  ///< the piece of each vertex; −1 for one without triangles
  /// Of each vertex, the image that belongs to its piece in one [m].
  std::vector<Vec3> position;
  /// Of each piece, the axes along which it does not run into its own image. Along the others it goes
  /// through the whole box, and `position` is any image, not always the one near its neighbours.
  std::vector<std::array<bool, 3>> bounded;
};

FilmPieces film_pieces(const FilmMesh& mesh, const Topology& topology);

}  // namespace spume::mesh
