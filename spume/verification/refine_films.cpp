#include "spume/verification/refine_films.hpp"

#include <algorithm>
#include <array>
#include <map>
#include <utility>
#include <vector>

#include "spume/base/contract.hpp"

namespace spume::verification {

namespace {

struct Edge {
  mesh::PhaseSet phases;
  bool cut = false;
  int middle = -1;
};

/// The edges of a mesh and those of each triangle; edge e of a triangle runs from corner e to the next.
struct Edges {
  std::vector<Edge> edge;
  std::vector<std::array<int, 2>> ends;
  std::vector<std::array<int, 3>> of_triangle;

  explicit Edges(const mesh::FilmMesh& mesh) {
    std::map<std::pair<int, int>, int> number;
    for (const auto& t : mesh.triangle) {
      auto& mine = of_triangle.emplace_back();
      for (int e = 0; e < 3; ++e) {
        const std::pair<int, int> key = std::minmax(t.vertex[e], t.vertex[(e + 1) % 3]);
        const auto [known, is_new] = number.try_emplace(key, static_cast<int>(edge.size()));
        if (is_new) {
          edge.emplace_back();
          ends.push_back({key.first, key.second});
        }
        mine[e] = known->second;
        edge[mine[e]].phases.insert(t.phase_a);
        edge[mine[e]].phases.insert(t.phase_b);
      }
    }
  }

  int n_cut(const std::array<int, 3>& triangle) const {
    return static_cast<int>(std::ranges::count_if(triangle, [&](int e) { return edge[e].cut; }));
  }

  /// Cuts all edges of the marked triangles and of those that would have two cut edges.
  void choose(std::span<const char> marked) {
    for (bool changed = true; changed;) {
      changed = false;
      for (std::size_t t = 0; t < of_triangle.size(); ++t) {
        const int n = n_cut(of_triangle[t]);
        if (n == 3 || (n < 2 && !marked[t])) continue;
        for (int e : of_triangle[t]) edge[e].cut = true;
        changed = true;
      }
    }
  }
};

}  // namespace

mesh::FilmMesh refine(const mesh::FilmMesh& mesh, std::span<const char> marked, const Middle& middle) {
  expects(marked.size() == mesh.triangle.size(), "one mark per triangle");
  expects(!mesh.domain.is_periodic(), "a mesh that is not periodic");
  Edges edges(mesh);
  edges.choose(marked);
  mesh::FilmMesh finer;
  finer.domain = mesh.domain;
  finer.position = mesh.position;
  for (std::size_t e = 0; e < edges.edge.size(); ++e) {
    if (!edges.edge[e].cut) continue;
    const auto [a, b] = edges.ends[e];
    edges.edge[e].middle = finer.n_vertices();
    finer.position.push_back(middle(mesh.position[a], mesh.position[b], edges.edge[e].phases));
  }
  for (int t = 0; t < mesh.n_triangles(); ++t) {
    const auto& old = mesh.triangle[t];
    const auto add = [&](int a, int b, int c) {
      finer.triangle.push_back({{a, b, c}, old.phase_a, old.phase_b});
    };
    const auto [v0, v1, v2] = old.vertex;
    const auto& mine = edges.of_triangle[t];
    const std::array<int, 3> m{edges.edge[mine[0]].middle, edges.edge[mine[1]].middle,
                               edges.edge[mine[2]].middle};
    if (edges.n_cut(mine) == 3) {
      add(v0, m[0], m[2]);
      add(m[0], v1, m[1]);
      add(m[2], m[1], v2);
      add(m[0], m[1], m[2]);
      continue;
    }
    const int cut = m[0] >= 0 ? 0 : m[1] >= 0 ? 1 : m[2] >= 0 ? 2 : -1;
    if (cut < 0) {
      add(v0, v1, v2);
    } else {
      const int from = old.vertex[cut], to = old.vertex[(cut + 1) % 3], across = old.vertex[(cut + 2) % 3];
      add(from, m[cut], across);
      add(m[cut], to, across);
    }
  }
  return finer;
}

mesh::FilmMesh refine_around(const mesh::FilmMesh& mesh, mesh::VertexKind kind, int layers,
                             const Middle& middle) {
  const mesh::Topology topology = mesh::build_topology(mesh);
  std::vector<char> reached(mesh.n_vertices(), 0), marked(mesh.n_triangles(), 0);
  for (int v = 0; v < mesh.n_vertices(); ++v) reached[v] = topology.vertex_kind[v] >= kind;
  for (int layer = 0; layer < layers; ++layer) {
    for (int t = 0; t < mesh.n_triangles(); ++t)
      marked[t] =
          marked[t] || std::ranges::any_of(mesh.triangle[t].vertex, [&](int v) { return reached[v]; });
    for (int t = 0; t < mesh.n_triangles(); ++t)
      if (marked[t])
        for (int v : mesh.triangle[t].vertex) reached[v] = 1;
  }
  return refine(mesh, marked, middle);
}

}  // namespace spume::verification
