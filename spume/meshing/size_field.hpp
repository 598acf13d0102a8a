#pragma once

#include <array>
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
  using Bin = std::array<int, 3>;
  struct Point {
    Bin bin;
    Vec3 position;
    double size;
  };

  void add(const Vec3& x, double size);
  void sort_points();
  void search(const Vec3& x, double& size) const;
  Bin bin_of(const Vec3& x) const;

  Domain domain_;
  Sizes sizes_;
  double reach_;  ///< beyond it no point counts [m]
  std::vector<Point> points_;
};

}  // namespace spume::meshing
