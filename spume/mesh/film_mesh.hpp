#pragma once

#include <array>
#include <vector>

#include "spume/base/domain.hpp"
#include "spume/base/vec3.hpp"
#include "spume/mesh/phase_set.hpp"

namespace spume::mesh {

/// A piece of film between two phases. Its normal, by the right-hand rule over the vertices, points from
/// phase_a into phase_b, and phase_a < phase_b always.
struct FilmTriangle {
  std::array<int, 3> vertex;
  Phase phase_a, phase_b;
};

/// The interface: conforming triangles of all films. The same on every rank. Everything else about it (phases
/// of a vertex, lamellae, Plateau borders, junctions) follows from these two arrays: see topology.hpp.
///
/// In a periodic box films continue across its faces: a vertex is stored by any of its images, and a triangle
/// joins those images of its vertices that are nearest to each other. Whoever needs differences of positions
/// takes them from edge() or corners().
struct FilmMesh {
  std::vector<Vec3> position;  ///< of vertices [m]
  std::vector<FilmTriangle> triangle;
  Domain domain;

  int n_vertices() const { return static_cast<int>(position.size()); }
  int n_triangles() const { return static_cast<int>(triangle.size()); }
  /// From one vertex to the nearest image of another [m].
  Vec3 edge(int from, int to) const { return domain.step(position[from], position[to]); }
  /// The corners of a triangle where they lie together: the first as stored [m].
  std::array<Vec3, 3> corners(int t) const {
    const auto& v = triangle[t].vertex;
    const Vec3& a = position[v[0]];
    return {a, domain.near(position[v[1]], a), domain.near(position[v[2]], a)};
  }
};

/// A triangle between phases p and q whose normal points from p into q, put in the order phase_a < phase_b.
FilmTriangle make_triangle(int v0, int v1, int v2, Phase p, Phase q);

/// Twice the area times the unit normal: (b − a) × (c − a) [m²].
inline Vec3 doubled_area_normal(const FilmMesh& mesh, int triangle) {
  const auto& v = mesh.triangle[triangle].vertex;
  return cross(mesh.edge(v[0], v[1]), mesh.edge(v[0], v[2]));
}
inline double triangle_area(const FilmMesh& mesh, int triangle) {
  return 0.5 * norm(doubled_area_normal(mesh, triangle));
}

/// Removes vertices that no triangle uses, keeping the order of the others.
/// Gives the new index of each old vertex, −1 for the removed ones.
std::vector<int> drop_unused_vertices(FilmMesh& mesh);

}  // namespace spume::mesh
