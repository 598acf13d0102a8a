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

/// Goes from vertex to vertex over all triangles that hang together with `first`, which stays as stored, and
/// puts each vertex near the one that it is reached from.
void put_together(const FilmMesh& mesh, const Topology& topology, int first, std::vector<char>& placed,
                  FilmPieces& pieces) {
  std::vector<int> open{first};
  placed[first] = 1;
  while (!open.empty()) {
    const int v = open.back();
    open.pop_back();
    for (int s = topology.star_offset[v]; s < topology.star_offset[v + 1]; ++s)
      for (int to : mesh.triangle[topology.star_triangle[s]].vertex) {
        const Vec3 x = mesh.domain.near(mesh.position[to], pieces.position[v]);
        if (!placed[to]) {
          placed[to] = 1;
          pieces.position[to] = x;
          open.push_back(to);
        }
        for (int d = 0; d < 3; ++d)
          if (mesh.domain.periodic[d] && std::abs(x[d] - pieces.position[to][d]) > 0.5 * mesh.domain.size[d])
            pieces.bounded[pieces.of_vertex[v]][d] = false;
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

  std::vector<char> placed(mesh.position.size(), 0);
  for (int v = 0; v < mesh.n_vertices(); ++v)
    if (!placed[v] && pieces.of_vertex[v] >= 0) put_together(mesh, topology, v, placed, pieces);
  return pieces;
}

}  // namespace spume::mesh
