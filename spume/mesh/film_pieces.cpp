#include "spume/mesh/film_pieces.hpp"

#include <algorithm>
#include <cmath>

#include "spume/base/union_find.hpp"

namespace spume::mesh {

namespace {

/// Whether two points are so near that no image of one is nearer to the other.
bool together(const Domain& domain, const Vec3& a, const Vec3& b) {
  for (int d = 0; d < 3; ++d)
    if (domain.periodic[d] && std::abs(a[d] - b[d]) > 0.5 * domain.size[d]) return false;
  return true;
}

/// Most foams lie inside their box, also a periodic one: no triangle is cut by its faces.
bool lie_as_stored(const FilmMesh& mesh) {
  return !mesh.domain.is_periodic() ||
         std::all_of(mesh.triangle.begin(), mesh.triangle.end(), [&](const FilmTriangle& t) {
           const Vec3 &a = mesh.position[t.vertex[0]], &b = mesh.position[t.vertex[1]],
                      &c = mesh.position[t.vertex[2]];
           return together(mesh.domain, a, b) && together(mesh.domain, a, c);
         });
}

/// Whether a piece runs into its own image along every axis that has images, so that any of them will do.
bool any_image_will_do(const Domain& domain, const std::array<bool, 3>& bounded) {
  for (int d = 0; d < 3; ++d)
    if (domain.periodic[d] && bounded[d]) return false;
  return true;
}

/// What has been reached so far, and the vertices to go on from.
struct Reached {
  std::vector<char> vertex, triangle;
  std::vector<int> open;
};

/// Goes from vertex to vertex over all triangles that hang together with `first`, which stays as stored, once
/// over each, and puts each vertex near the one that it is reached from. Where a triangle lies apart all the
/// same, the piece goes through the box; once it does so along all axes that have images, the rest stays as
/// stored.
void put_together(const FilmMesh& mesh, const Topology& topology, int first, Reached& reached,
                  FilmPieces& pieces) {
  const Domain& domain = mesh.domain;
  reached.open.push_back(first);
  reached.vertex[first] = 1;
  while (!reached.open.empty()) {
    const int v = reached.open.back();
    reached.open.pop_back();
    const Vec3 here = pieces.position[v];
    std::array<bool, 3>& bounded = pieces.bounded[pieces.of_vertex[v]];
    for (int s = topology.star_offset[v]; s < topology.star_offset[v + 1]; ++s) {
      const int t = topology.star_triangle[s];
      if (reached.triangle[t]) continue;
      reached.triangle[t] = 1;
      for (int to : mesh.triangle[t].vertex) {
        Vec3& x = pieces.position[to];
        if (!reached.vertex[to]) {
          reached.vertex[to] = 1;
          x = domain.near(x, here);
          reached.open.push_back(to);
        } else if (!together(domain, x, here)) {
          for (int d = 0; d < 3; ++d)
            if (domain.periodic[d] && std::abs(x[d] - here[d]) > 0.5 * domain.size[d]) bounded[d] = false;
          if (any_image_will_do(domain, bounded)) return reached.open.clear();
        }
      }
    }
  }
}

}  // namespace

FilmPieces film_pieces(const FilmMesh& mesh, const Topology& topology) {
  UnionFind lamellae(topology.n_lamellae());
  for (const auto& edge : topology.border_edge)
    for (int t : edge.triangle)
      lamellae.join(topology.triangle_lamella[edge.triangle[0]], topology.triangle_lamella[t]);
  std::vector<int> piece_of_lamella;
  FilmPieces pieces;
  pieces.count = lamellae.number(piece_of_lamella);
  pieces.bounded.assign(pieces.count, {true, true, true});
  pieces.position = mesh.position;
  pieces.of_vertex.assign(mesh.position.size(), -1);
  for (int v = 0; v < mesh.n_vertices(); ++v)
    if (topology.star_offset[v] < topology.star_offset[v + 1])
      pieces.of_vertex[v] =
          piece_of_lamella[topology.triangle_lamella[topology.star_triangle[topology.star_offset[v]]]];
  if (lie_as_stored(mesh)) return pieces;

  Reached reached{std::vector<char>(mesh.position.size(), 0), std::vector<char>(mesh.triangle.size(), 0), {}};
  for (int v = 0; v < mesh.n_vertices(); ++v)
    if (!reached.vertex[v] && pieces.of_vertex[v] >= 0 &&
        !any_image_will_do(mesh.domain, pieces.bounded[pieces.of_vertex[v]]))
      put_together(mesh, topology, v, reached, pieces);
  return pieces;
}

}  // namespace spume::mesh
