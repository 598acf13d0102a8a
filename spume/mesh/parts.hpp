#pragma once

#include <functional>
#include <vector>

#include "spume/mesh/film_mesh.hpp"
#include "spume/parallel/communicator.hpp"

namespace spume::mesh {

/// Work on a part of a mesh, which is a mesh of its own. Its first n_cut vertices are on the cut: triangles
/// beyond the part use them too. They must stay where they are and keep their numbers; the others, of which
/// the part has all triangles, may change as they like.
using PartWork = std::function<void(FilmMesh& part, int n_cut)>;

/// Does `work` on the parts 0 … n_parts − 1 of a mesh and puts them together again, with the triangles of
/// part n_parts, which stay as they are; `part_of_triangle` has one entry a triangle. Vertices are
/// renumbered: first those on cuts, whose number this gives, then the others part by part, in their order in
/// the part. Collective: each rank holds the mesh, works on an even share of the parts and gets the whole;
/// the result does not depend on the number of ranks. What `work` throws on one rank, all throw.
int work_in_parts(FilmMesh& mesh, const std::vector<int>& part_of_triangle, int n_parts, const PartWork& work,
                  const parallel::Communicator& ranks);

/// Cuts a mesh into slabs across z with the same number of vertices.
class Slabs {
 public:
  Slabs(const FilmMesh& mesh, int n_slabs);

  int count() const { return static_cast<int>(bound_.size()) + 1; }
  /// The slab of a point: 0 is the lowest.
  int of(const Vec3& x) const;
  /// The slab of each triangle: that of its lowest corner, so that the cut between two slabs is in the upper;
  /// that around a periodic box is in the last.
  std::vector<int> of_triangles(const FilmMesh& mesh) const;

 private:
  std::vector<double> bound_;  ///< between one slab and the next [m]
};

/// After work on the slabs of a mesh, whose first n_cut vertices are on the cuts: the parts around these, as
/// many as slabs less one, reaching `n_rings` edges to both sides. Other triangles are of the part after the
/// last.
std::vector<int> seams_of_triangles(const FilmMesh& mesh, const Slabs& slabs, int n_cut, int n_rings);

}  // namespace spume::mesh
