#include "spume/mesh/topology.hpp"

#include <algorithm>
#include <array>
#include <span>
#include <utility>

#include "spume/base/union_find.hpp"

namespace spume::mesh {

namespace {

/// A side of a triangle at the vertex of its edge with the lower number.
struct Side {
  int high;  ///< the other vertex
  int triangle;
  bool forward;  ///< runs from low to high
};

/// Which corner of a triangle a vertex of its is.
int corner_of(const FilmTriangle& triangle, int vertex) {
  return triangle.vertex[0] == vertex ? 0 : triangle.vertex[1] == vertex ? 1 : 2;
}

/// The sides at a vertex that is the lower one of their edge: of each edge in a row, in the order of
/// triangles.
void find_sides(const FilmMesh& mesh, const Topology& topology, int low, std::vector<Side>& sides) {
  sides.clear();
  const auto insert = [&](const Side& side) {
    std::size_t n = sides.size();
    sides.push_back(side);
    for (; n > 0 && sides[n - 1].high > side.high; --n) sides[n] = sides[n - 1];
    sides[n] = side;
  };
  for (int s = topology.star_offset[low]; s < topology.star_offset[low + 1]; ++s) {
    const int t = topology.star_triangle[s];
    const auto& v = mesh.triangle[t].vertex;
    const int c = corner_of(mesh.triangle[t], low);
    if (const int next = v[(c + 1) % 3]; next > low) insert({next, t, true});
    if (const int last = v[(c + 2) % 3]; last > low) insert({last, t, false});
  }
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
  const auto some_more = static_cast<std::size_t>(1.2 * mesh.n_vertices());  // a vertex on a border has three
  pair_of_dof.reserve(some_more);
  topology.film_dof.reserve(some_more);
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
      topology.corner_dof[t][corner_of(triangle, v)] = dof;
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

PhaseSet phases_of(const FilmMesh& mesh, const std::array<int, 3>& triangles) {
  PhaseSet phases;
  for (int t : triangles) {
    phases.insert(mesh.triangle[t].phase_a);
    phases.insert(mesh.triangle[t].phase_b);
  }
  return phases;
}

/// Whether three triangles at an edge are three films of three phases: a border.
bool is_border(const FilmMesh& mesh, const std::array<int, 3>& triangles) {
  const FilmTriangle &a = mesh.triangle[triangles[0]], &b = mesh.triangle[triangles[1]],
                     &c = mesh.triangle[triangles[2]];
  return phases_of(mesh, triangles).size() == 3 && !same_phases(a, b) && !same_phases(a, c) &&
         !same_phases(b, c);
}

/// Whether of the edges from a vertex of two phases to higher ones each has two triangles, on opposite sides:
/// true of nearly all, and found without sorting. Not answered (false) for stars of many triangles.
bool lies_inside_film(const FilmMesh& mesh, const Topology& topology, int low) {
  constexpr int most = 12;
  if (topology.vertex_phases[low].size() != 2) return false;
  const int begin = topology.star_offset[low], end = topology.star_offset[low + 1];
  if (end - begin > most) return false;
  std::array<int, most> forward, backward;  // ends of edges that run from low, and of those that run to it
  int n_forward = 0, n_backward = 0;
  for (int s = begin; s < end; ++s) {
    const FilmTriangle& triangle = mesh.triangle[topology.star_triangle[s]];
    const int c = corner_of(triangle, low), next = triangle.vertex[(c + 1) % 3],
              last = triangle.vertex[(c + 2) % 3];
    forward[n_forward] = next;
    n_forward += next > low;
    backward[n_backward] = last;
    n_backward += last > low;
  }
  if (n_forward != n_backward) return false;
  for (int n = 0; n < n_forward; ++n) {
    int n_same = 0, n_opposite = 0;
    for (int m = 0; m < n_forward; ++m) {
      n_same += forward[m] == forward[n];
      n_opposite += backward[m] == forward[n];
    }
    if (n_same != 1 || n_opposite != 1) return false;
  }
  return true;
}

/// Sorts the edges into those inside a lamella, those on borders, and the rest, which should not be.
void find_border_edges(const FilmMesh& mesh, Topology& topology) {
  std::vector<Side> sides;
  for (int low = 0; low < mesh.n_vertices(); ++low) {
    if (lies_inside_film(mesh, topology, low)) continue;
    find_sides(mesh, topology, low, sides);
    for (std::size_t first = 0, last; first < sides.size(); first = last) {
      last = first;
      while (last < sides.size() && sides[last].high == sides[first].high) ++last;
      const std::span edge(sides.data() + first, last - first);
      if (edge.size() == 2) {
        const bool inside = same_phases(mesh.triangle[edge[0].triangle], mesh.triangle[edge[1].triangle]) &&
                            edge[0].forward != edge[1].forward;
        topology.n_nonconforming_edges += !inside;
        continue;
      }
      if (edge.size() == 3) {
        const std::array triangles{edge[0].triangle, edge[1].triangle, edge[2].triangle};
        if (is_border(mesh, triangles)) {
          topology.border_edge.push_back({{low, edge[0].high}, {-1, -1}, -1, triangles});
          continue;
        }
      }
      ++topology.n_nonconforming_edges;
    }
  }
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
  using Key = std::array<int, 4>;  // vertex, phases
  std::vector<Key> key_of_end;     // [2 edge + end]
  key_of_end.reserve(2 * topology.border_edge.size());
  for (const auto& edge : topology.border_edge) {
    const PhaseSet phases = phases_of(mesh, edge.triangle);
    for (int v : edge.vertex) key_of_end.push_back({v, phases[0], phases[1], phases[2]});
  }
  std::vector<Key> keys = key_of_end;
  std::ranges::sort(keys);
  keys.erase(std::ranges::unique(keys).begin(), keys.end());
  const int n = static_cast<int>(keys.size());
  for (const Key& key : keys) topology.border_dof.push_back({key[0], -1});
  UnionFind classes(n);
  std::vector<std::vector<int>> edges_of_dof(n);
  for (int e = 0; e < static_cast<int>(topology.border_edge.size()); ++e) {
    auto& edge = topology.border_edge[e];
    for (int end = 0; end < 2; ++end) {
      edge.border_dof[end] =
          static_cast<int>(std::ranges::lower_bound(keys, key_of_end[2 * e + end]) - keys.begin());
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
    topology.border[b].phases = {keys[d][1], keys[d][2], keys[d][3]};
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
