#include "spume/interface/contour_parts.hpp"

#include <utility>

namespace spume::interface {

mesh::FilmMesh joined(const parallel::Communicator& ranks, ContourPart part) {
  if (ranks.size() == 1) return std::move(part.films);
  std::vector<int> vertices, triangles, seams;
  const auto position = ranks.joined(std::move(part.films.position), vertices);
  auto triangle = ranks.joined(std::move(part.films.triangle), triangles);
  const auto seam = ranks.joined(std::move(part.seam), seams);

  mesh::FilmMesh films;
  films.domain = part.films.domain;
  VertexNumbers vertex_of;
  std::vector<int> number;  // of the vertices of a part
  for (int rank = 0; rank < ranks.size(); ++rank) {
    number.assign(vertices[rank + 1] - vertices[rank], -1);
    for (int s = seams[rank], v = 0; v < static_cast<int>(number.size()); ++v) {
      number[v] = films.n_vertices();
      if (s < seams[rank + 1] && seam[s].number == v)
        number[v] = vertex_of.find_or_insert(seam[s++].key, number[v]);
      if (number[v] == films.n_vertices()) films.position.push_back(position[vertices[rank] + v]);
    }
    for (int t = triangles[rank]; t < triangles[rank + 1]; ++t)
      for (int& v : triangle[t].vertex) v = number[v];
  }
  films.triangle = std::move(triangle);
  return films;
}

}  // namespace spume::interface
