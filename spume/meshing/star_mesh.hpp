#pragma once

#include <array>
#include <vector>

#include "spume/mesh/working_mesh.hpp"

namespace spume::meshing {

using Corners = std::array<Vec3, 3>;

/// How bad the shape of a triangle is: the cosine of its smallest angle (½ for an equilateral one, 1 for a
/// sliver), and 2 where its normal is turned by more than 72 degrees from `film_normal` (of any length).
double badness(const Corners& corners, const Vec3& film_normal);
/// That of a triangle whose smallest angle is the given one, not turned.
double badness_of_angle(double degrees);

/// A mesh under improvement with the triangles at each vertex and their normals, which every change keeps up
/// to date. Triangles that are gone stay marked as dead until the mesh is swept.
class StarMesh {
 public:
  explicit StarMesh(mesh::WorkingMesh& working_mesh);

  /// Puts vertex v at x.
  void move(int v, const Vec3& x);
  /// To be called after the corners of a triangle have changed, or when one is new at the end.
  void renew(int triangle);

  bool has(int triangle, int v) const;
  /// Number of triangles at the edge between two vertices, which need not exist.
  int n_triangles_between(int v, int w) const;
  bool is_border_edge(int v, int w) const { return n_triangles_between(v, w) == 3; }
  bool is_near_border(int v) const;

  /// Corners of a triangle, those beside the first as they lie together with it [m].
  Corners corners(int triangle) const { return films.corners(triangle); }
  /// The same with vertex v at x.
  Corners corners_with(int triangle, int v, const Vec3& x) const;
  /// Normal of the film around a triangle: the sum of doubled areas over all triangles of the same two phases
  /// at its corners [m²].
  Vec3 film_normal(int triangle) const;
  /// The part of that sum at one corner, which other triangles of the film share.
  Vec3 film_normal_at(int v, mesh::Phase phase_a, mesh::Phase phase_b) const;

  double badness_of(int triangle) const { return badness(corners(triangle), film_normal(triangle)); }

  mesh::WorkingMesh& work;
  mesh::FilmMesh& films;
  std::vector<std::vector<int>> star;
  std::vector<char> dead;  ///< of triangles

 private:
  std::vector<Vec3> normal_;  ///< of triangles, as long as twice their areas [m²]
};

}  // namespace spume::meshing
