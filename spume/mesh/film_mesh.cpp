#include "spume/mesh/film_mesh.hpp"

#include <utility>

namespace spume::mesh {

FilmTriangle make_triangle(int v0, int v1, int v2, Phase p, Phase q) {
  if (p < q) return {{v0, v1, v2}, p, q};
  return {{v0, v2, v1}, q, p};
}

std::vector<int> drop_unused_vertices(FilmMesh& mesh) {
  std::vector<int> new_index(mesh.position.size(), -1);
  for (const auto& t : mesh.triangle)
    for (int v : t.vertex) new_index[v] = 0;
  int n = 0;
  for (std::size_t v = 0; v < new_index.size(); ++v) {
    if (new_index[v] < 0) continue;
    mesh.position[n] = mesh.position[v];
    new_index[v] = n++;
  }
  mesh.position.resize(n);
  for (auto& t : mesh.triangle)
    for (int& v : t.vertex) v = new_index[v];
  return new_index;
}

}  // namespace spume::mesh
