#include "spume/rupture/merge_phases.hpp"

#include <array>
#include <map>

namespace spume::rupture {

namespace {

/// Follows the border edges that are still borders.
std::vector<int> follow_border_dofs(const mesh::Topology& before, const mesh::Topology& after,
                                    const std::vector<int>& new_vertex) {
  std::map<std::array<int, 2>, int> new_edge;
  for (std::size_t e = 0; e < after.border_edge.size(); ++e)
    new_edge[after.border_edge[e].vertex] = static_cast<int>(e);
  std::vector<int> dof(before.border_dof.size(), -1);
  for (const auto& edge : before.border_edge) {
    // Dropping vertices keeps their order, so the lower end stays the lower end.
    const auto found = new_edge.find({new_vertex[edge.vertex[0]], new_vertex[edge.vertex[1]]});
    if (found == new_edge.end()) continue;
    for (int end = 0; end < 2; ++end)
      dof[edge.border_dof[end]] = after.border_edge[found->second].border_dof[end];
  }
  return dof;
}

}  // namespace

MergedMesh merge_phases(const mesh::FilmMesh& films, const mesh::Topology& topology, mesh::Phase kept,
                        mesh::Phase gone) {
  const auto renamed = [&](mesh::Phase p) { return p == gone ? kept : p; };
  MergedMesh merged;
  merged.films.position = films.position;
  merged.films.domain = films.domain;
  std::vector<int> old_triangle;
  for (int t = 0; t < films.n_triangles(); ++t) {
    const auto& triangle = films.triangle[t];
    const mesh::Phase a = renamed(triangle.phase_a), b = renamed(triangle.phase_b);
    if (a == b) continue;
    merged.films.triangle.push_back(
        mesh::make_triangle(triangle.vertex[0], triangle.vertex[1], triangle.vertex[2], a, b));
    old_triangle.push_back(t);
  }
  const std::vector<int> new_vertex = mesh::drop_unused_vertices(merged.films);
  merged.topology = mesh::build_topology(merged.films);

  merged.film_dof.assign(topology.film_dof.size(), -1);
  merged.lamella.assign(topology.lamella.size(), -1);
  for (std::size_t t = 0; t < old_triangle.size(); ++t) {
    const auto& old_vertex = films.triangle[old_triangle[t]].vertex;
    // make_triangle may have turned the triangle around: corners are found by their vertices.
    for (int c = 0; c < 3; ++c)
      for (int k = 0; k < 3; ++k)
        if (new_vertex[old_vertex[c]] == merged.films.triangle[t].vertex[k])
          merged.film_dof[topology.corner_dof[old_triangle[t]][c]] = merged.topology.corner_dof[t][k];
    merged.lamella[topology.triangle_lamella[old_triangle[t]]] = merged.topology.triangle_lamella[t];
  }
  merged.border_dof = follow_border_dofs(topology, merged.topology, new_vertex);
  return merged;
}

}  // namespace spume::rupture
