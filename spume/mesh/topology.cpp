#include "spume/mesh/topology.hpp"

#include <algorithm>
#include <map>
#include <numeric>

#include "spume/base/union_find.hpp"

namespace spume::mesh {

namespace {

/// A side of a triangle, sorted so that the sides of one edge are neighbours.
struct Side {
  int low, high;  ///< vertices of the edge
  int triangle;
  bool forward;  ///< runs from low to high
};

/// Buckets by the lower vertex, filled in the order of triangles; then each, of a few sides, is sorted by the
/// higher vertex.
std::vector<Side> sorted_sides(const FilmMesh& mesh) {
  const auto for_each_side = [&](auto&& body) {
    for (int t = 0; t < mesh.n_triangles(); ++t)
      for (int e = 0; e < 3; ++e) {
        const int a = mesh.triangle[t].vertex[e], b = mesh.triangle[t].vertex[(e + 1) % 3];
        body(Side{std::min(a, b), std::max(a, b), t, a < b});
      }
  };
  std::vector<int> end(mesh.n_vertices() + 1, 0);
  for_each_side([&](const Side& side) { ++end[side.low + 1]; });
  std::partial_sum(end.begin(), end.end(), end.begin());
  std::vector<Side> sides(3 * mesh.triangle.size());
  for_each_side([&](const Side& side) { sides[end[side.low]++] = side; });
  for (int v = 0, first = 0; v < mesh.n_vertices(); first = end[v++])
    for (int n = first + 1; n < end[v]; ++n) {
      const Side side = sides[n];
      int m = n;
      for (; m > first && sides[m - 1].high > side.high; --m) sides[m] = sides[m - 1];
      sides[m] = side;
    }
  return sides;
}

bool same_phases(const FilmTriangle& a, const FilmTriangle& b) {
  return a.phase_a == b.phase_a && a.phase_b == b.phase_b;
}

void find_phases_and_stars(const FilmMesh& mesh, VertexTopology& topology) {
  const int n = mesh.n_vertices();
  topology.vertex_phases.assign(n, {});
  topology.star_offset.assign(n + 1, 0);
  for (const auto& t : mesh.triangle)
    for (int v : t.vertex) {
      topology.vertex_phases[v].insert(t.phase_a);
      topology.vertex_phases[v].insert(t.phase_b);
      ++topology.star_offset[v + 1];
    }
  for (int v = 0; v < n; ++v) topology.star_offset[v + 1] += topology.star_offset[v];
  topology.star_triangle.resize(3 * mesh.triangle.size());
  std::vector<int> next(topology.star_offset.begin(), topology.star_offset.end() - 1);
  for (int t = 0; t < mesh.n_triangles(); ++t)
    for (int v : mesh.triangle[t].vertex) topology.star_triangle[next[v]++] = t;

  topology.vertex_kind.resize(n);
  for (int v = 0; v < n; ++v) {
    const int n_phases = topology.vertex_phases[v].size();
    topology.vertex_kind[v] = n_phases <= 2   ? VertexKind::Film
                              : n_phases == 3 ? VertexKind::Border
                                              : VertexKind::Junction;
    if (n_phases >= 4) topology.junction.push_back(v);
  }
}

/// Film dofs are the pairs (vertex, phase pair) in increasing order of vertex; lamellae their connected
/// classes.
void find_lamellae(const FilmMesh& mesh, Topology& topology) {
  topology.corner_dof.resize(mesh.triangle.size());
  std::vector<std::pair<Phase, Phase>> pair_of_dof;
  for (int v = 0; v < mesh.n_vertices(); ++v) {
    const int first = static_cast<int>(pair_of_dof.size());
    for (int s = topology.star_offset[v]; s < topology.star_offset[v + 1]; ++s) {
      const int t = topology.star_triangle[s];
      const auto& triangle = mesh.triangle[t];
      const std::pair<Phase, Phase> pair{triangle.phase_a, triangle.phase_b};
      const auto known = std::find(pair_of_dof.begin() + first, pair_of_dof.end(), pair);
      const int dof = static_cast<int>(known - pair_of_dof.begin());
      if (known == pair_of_dof.end()) {
        pair_of_dof.push_back(pair);
        topology.film_dof.push_back({v, -1});
      }
      for (int c = 0; c < 3; ++c)
        if (triangle.vertex[c] == v) topology.corner_dof[t][c] = dof;
    }
  }

  UnionFind classes(static_cast<int>(pair_of_dof.size()));
  for (const auto& dof : topology.corner_dof) {
    classes.join(dof[0], dof[1]);
    classes.join(dof[0], dof[2]);
  }
  std::vector<int> lamella_of_dof;
  topology.lamella.resize(classes.number(lamella_of_dof));
  for (std::size_t d = 0; d < pair_of_dof.size(); ++d) {
    topology.film_dof[d].lamella = lamella_of_dof[d];
    topology.lamella[lamella_of_dof[d]] = {pair_of_dof[d].first, pair_of_dof[d].second};
  }
  topology.triangle_lamella.resize(mesh.triangle.size());
  for (int t = 0; t < mesh.n_triangles(); ++t)
    topology.triangle_lamella[t] = lamella_of_dof[topology.corner_dof[t][0]];
}

/// Sorts the edges into those inside a lamella, those on borders, and the rest, which should not be.
void find_border_edges(const FilmMesh& mesh, Topology& topology) {
  const std::vector<Side> sides = sorted_sides(mesh);
  for (std::size_t first = 0, last; first < sides.size(); first = last) {
    last = first;
    while (last < sides.size() && sides[last].low == sides[first].low &&
           sides[last].high == sides[first].high)
      ++last;
    const auto triangle = [&](std::size_t s) -> const FilmTriangle& {
      return mesh.triangle[sides[s].triangle];
    };
    bool conforming = false;
    if (last - first == 2) {
      conforming = same_phases(triangle(first), triangle(first + 1)) &&
                   sides[first].forward != sides[first + 1].forward;
    } else if (last - first == 3) {
      PhaseSet phases;
      for (std::size_t s = first; s < last; ++s) {
        phases.insert(triangle(s).phase_a);
        phases.insert(triangle(s).phase_b);
      }
      conforming = phases.size() == 3 && !same_phases(triangle(first), triangle(first + 1)) &&
                   !same_phases(triangle(first), triangle(first + 2)) &&
                   !same_phases(triangle(first + 1), triangle(first + 2));
      if (conforming)
        topology.border_edge.push_back(
            {{sides[first].low, sides[first].high},
             {-1, -1},
             -1,
             {sides[first].triangle, sides[first + 1].triangle, sides[first + 2].triangle}});
    }
    if (!conforming) ++topology.n_nonconforming_edges;
  }
}

PhaseSet phases_of(const FilmMesh& mesh, const BorderEdge& edge) {
  PhaseSet phases;
  for (int t : edge.triangle) {
    phases.insert(mesh.triangle[t].phase_a);
    phases.insert(mesh.triangle[t].phase_b);
  }
  return phases;
}

/// Walks along a border from one dof to the next and lists the vertices in order.
std::vector<int> walk(const Topology& topology, const std::vector<std::vector<int>>& edges_of_dof,
                      int start_dof) {
  std::vector<int> vertices{topology.border_dof[start_dof].vertex};
  std::vector<int> walked;
  for (int dof = start_dof;;) {
    int next_edge = -1;
    for (int e : edges_of_dof[dof])
      if (walked.empty() || e != walked.back()) {
        next_edge = e;
        break;
      }
    if (next_edge < 0 || (!walked.empty() && next_edge == walked.front())) return vertices;
    walked.push_back(next_edge);
    const auto& ends = topology.border_edge[next_edge].border_dof;
    dof = ends[0] == dof ? ends[1] : ends[0];
    vertices.push_back(topology.border_dof[dof].vertex);
    if (vertices.size() > topology.border_edge.size() + 1) return vertices;
    if (dof == start_dof) return vertices;
  }
}

/// Border dofs are the pairs (vertex, three phases); borders their connected classes.
void find_borders(const FilmMesh& mesh, Topology& topology) {
  std::map<std::pair<int, PhaseSet>, int> dof_of;
  for (const auto& edge : topology.border_edge)
    for (int v : edge.vertex) dof_of.emplace(std::pair(v, phases_of(mesh, edge)), 0);
  int n = 0;
  std::vector<PhaseSet> phases_of_dof;
  for (auto& [key, dof] : dof_of) {
    dof = n++;
    topology.border_dof.push_back({key.first, -1});
    phases_of_dof.push_back(key.second);
  }
  UnionFind classes(n);
  std::vector<std::vector<int>> edges_of_dof(n);
  for (int e = 0; e < static_cast<int>(topology.border_edge.size()); ++e) {
    auto& edge = topology.border_edge[e];
    const PhaseSet phases = phases_of(mesh, edge);
    for (int end = 0; end < 2; ++end) {
      edge.border_dof[end] = dof_of.at({edge.vertex[end], phases});
      edges_of_dof[edge.border_dof[end]].push_back(e);
    }
    classes.join(edge.border_dof[0], edge.border_dof[1]);
  }
  std::vector<int> border_of_dof;
  topology.border.resize(classes.number(border_of_dof));
  for (auto& edge : topology.border_edge) edge.border = border_of_dof[edge.border_dof[0]];

  std::vector<int> start(topology.border.size(), -1);
  std::vector<char> has_end(topology.border.size(), 0);
  for (int d = 0; d < n; ++d) {
    const int b = border_of_dof[d];
    topology.border_dof[d].border = b;
    const PhaseSet& phases = phases_of_dof[d];
    topology.border[b].phases = {phases[0], phases[1], phases[2]};
    const bool is_end = edges_of_dof[d].size() == 1;
    if (start[b] < 0 || (is_end && !has_end[b])) start[b] = d;
    has_end[b] = has_end[b] || is_end;
  }
  for (std::size_t b = 0; b < topology.border.size(); ++b) {
    topology.border[b].closed = !has_end[b];
    topology.border[b].vertices = walk(topology, edges_of_dof, start[b]);
  }
}

}  // namespace

VertexTopology build_vertex_topology(const FilmMesh& mesh) {
  VertexTopology topology;
  find_phases_and_stars(mesh, topology);
  return topology;
}

Topology build_topology(const FilmMesh& mesh) {
  Topology topology;
  find_phases_and_stars(mesh, topology);
  find_lamellae(mesh, topology);
  find_border_edges(mesh, topology);
  find_borders(mesh, topology);
  return topology;
}

}  // namespace spume::mesh
