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

/// Cuts a mesh into slabs with the same number of vertices, across the axis along which the mesh is longest
/// (z before y before x when it is as long along them).
class Slabs {
 public:
  /// The largest number n_at_most / 2ⁿ of slabs, none of them thinner than least_thickness [m], or one. The
  /// first and the last may be thinner where the box does not continue there, since nothing lies beyond them.
  /// n_at_most is a power of two.
  Slabs(const FilmMesh& mesh, int n_at_most, double least_thickness);

  int count() const { return static_cast<int>(bound_.size()) + 1; }
  /// The axis that the slabs are across: 0, 1 or 2.
  int axis() const { return axis_; }
  /// The slab of a point, or of that image of it which is in the box: 0 is the lowest.
  int of(const Vec3& x) const;
  /// The slab of each triangle: that of its lowest corner, so that the cut between two slabs is in the upper;
  /// that around a periodic box is in the last.
  std::vector<int> of_triangles(const FilmMesh& mesh) const;

 private:
  double height(const Vec3& x) const;
  double thinnest() const;

  Domain domain_;
  int axis_;
  std::vector<double> bound_;  ///< between one slab and the next [m]
};

/// The parts of a mesh around the cuts between its slabs.
struct Seams {
  std::vector<int> of_triangle;  ///< `count` for triangles that are in none
  int count;
};
/// After work on the slabs of a mesh, whose first n_cut vertices are on the cuts: the seams around these,
/// reaching `n_rings` edges to both sides. Seams that overlap are one, so that no vertex on a cut is within
/// n_rings edges of the end of its seam.
Seams seams_around_cuts(const FilmMesh& mesh, const Slabs& slabs, int n_cut, int n_rings);

}  // namespace spume::mesh
