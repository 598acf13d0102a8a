#pragma once

#include <array>
#include <vector>

#include "spume/mesh/working_mesh.hpp"

namespace spume::mesh {

/// Flips edges inside a lamella whose two opposite angles exceed π together (by 0.05, so that squares stay),
/// towards the Delaunay triangulation. An edge stays when a triangle would turn by more than 60 degrees, when
/// the new edge exists already (as seen from a vertex inside the film, whose triangles are one fan in a
/// conforming mesh), or when it would join two points of borders across the film, or two that may be, which
/// points of a cut are.
class EdgeFlipper {
 public:
  /// Between the runs vertices of `work` may move, but its triangles stay.
  explicit EdgeFlipper(WorkingMesh& work);

  /// Up to three rounds, of all edges and then of those beside a flip; gives the number of flips.
  int run();

 private:
  /// Two triangles of one lamella along the edge from `a` to `b`: the left one has the third corner `left`,
  /// the right one, in which the edge runs from `b` to `a`, has `right`.
  struct Hinge {
    int a, b, left, right;
  };
  static Hinge hinge_of(const FilmMesh& mesh, const EdgeUse& left, const EdgeUse& right);
  bool improves(const Hinge& e, const EdgeUse& l, const EdgeUse& r) const;
  bool is_inner_film(int v) const;
  bool is_neighbour(const EdgeUse& start, int q) const;
  void flip(const Hinge& e, const EdgeUse& left, const EdgeUse& right);
  void link(const EdgeUse& side, const EdgeUse& other);

  WorkingMesh& work_;
  /// Across each side of each triangle, from vertex[c] to the next: the side of the other triangle of the
  /// film, none (−1) at its ends.
  std::vector<std::array<EdgeUse, 3>> across_;
};

/// One run on a mesh as it is.
int flip_edges(WorkingMesh& work);

}  // namespace spume::mesh
