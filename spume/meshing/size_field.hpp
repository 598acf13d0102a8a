#pragma once

#include <vector>

#include "spume/mesh/film_mesh.hpp"
#include "spume/mesh/topology.hpp"

namespace spume::meshing {

/// Target edge lengths [m] that a mesh is graded by.
struct Sizes {
  double in_films;      ///< far from borders
  double at_borders;    ///< not above in_films
  double at_junctions;  ///< not above at_borders
  double smallest;      ///< where borders are short and films narrow, not below this
  double grading;       ///< growth of the target a unit of distance, > 0
};

/// Wanted edge length at any point: the largest function that grows by `grading` a unit of distance at most,
/// exceeds in_films nowhere, and at each point of a Plateau border is at most
///  - at_borders, and at_junctions where borders end;
///  - the length of the border, if it is open;
///  - the width there of each film it bounds: the distance to a part of the film's rim that is much nearer
///    across the film than along the rim.
/// So a film a few cells wide, or a border shorter than a cell, has triangles of its own size around it.
/// Distances are through space: a film is graded by a border of another that passes close by, too.
class SizeField {
 public:
  SizeField(const mesh::FilmMesh& films, const mesh::Topology& topology, const Sizes& sizes);

  double operator()(const Vec3& x) const;

 private:
  struct Point {
    Vec3 position;
    double size;
  };
  /// Points [first, last) and a box around them; the node's halves are the next node and `right`, or it has
  /// none where that is 0.
  struct Node {
    int first, last, right;
    Vec3 low, high;
    double least;  ///< size
  };

  void add(const Vec3& x, double size);
  int build_tree(int first, int last);
  void search(const Vec3& x, double& size) const;

  Domain domain_;
  Sizes sizes_;
  double reach_;  ///< beyond it no point counts [m]
  std::vector<Point> points_;
  std::vector<Node> nodes_;  ///< the root first
};

}  // namespace spume::meshing
