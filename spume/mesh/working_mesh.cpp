#include "spume/mesh/working_mesh.hpp"

#include <algorithm>
#include <numeric>

#include "spume/base/contract.hpp"

namespace spume::mesh {

EdgeTable build_edges(const FilmMesh& mesh) {
  struct Side {
    int high;
    EdgeUse use;
  };
  // Buckets by the lower vertex, in triangle order; then each, of a few sides, is sorted by the higher
  // vertex.
  std::vector<int> offset(mesh.n_vertices() + 1, 0);
  for (const FilmTriangle& t : mesh.triangle)
    for (int c = 0; c < 3; ++c) ++offset[std::min(t.vertex[c], t.vertex[(c + 1) % 3]) + 1];
  std::partial_sum(offset.begin(), offset.end(), offset.begin());
  std::vector<Side> side(offset.back());
  std::vector<int> end(offset.begin(), offset.end() - 1);
  for (int t = 0; t < mesh.n_triangles(); ++t)
    for (int c = 0; c < 3; ++c) {
      const auto [low, high] = std::minmax(mesh.triangle[t].vertex[c], mesh.triangle[t].vertex[(c + 1) % 3]);
      side[end[low]++] = {high, {t, c}};
    }

  EdgeTable table;
  table.edge.reserve(side.size() / 2);
  table.use.reserve(side.size());
  for (int low = 0; low < mesh.n_vertices(); ++low) {
    for (int n = offset[low] + 1; n < offset[low + 1]; ++n) {
      const Side moving = side[n];
      int m = n;
      for (; m > offset[low] && side[m - 1].high > moving.high; --m) side[m] = side[m - 1];
      side[m] = moving;
    }
    for (int s = offset[low]; s < offset[low + 1]; ++s) {
      if (s == offset[low] || side[s].high != side[s - 1].high)
        table.edge.push_back({low, side[s].high, s, 0});
      ++table.edge.back().n_uses;
      table.use.push_back(side[s].use);
    }
  }
  return table;
}

std::vector<std::vector<int>> vertex_stars(const FilmMesh& mesh) {
  std::vector<int> n_triangles(mesh.n_vertices(), 0);
  for (const FilmTriangle& t : mesh.triangle)
    for (int v : t.vertex) ++n_triangles[v];
  std::vector<std::vector<int>> star(mesh.n_vertices());
  for (int v = 0; v < mesh.n_vertices(); ++v) star[v].reserve(n_triangles[v] + 2);  // room for a few more
  for (int t = 0; t < mesh.n_triangles(); ++t)
    for (int v : mesh.triangle[t].vertex) star[v].push_back(t);
  return star;
}

VertexStars::VertexStars(const FilmMesh& mesh) : offset_(mesh.n_vertices() + 1, 0) {
  for (const FilmTriangle& t : mesh.triangle)
    for (int v : t.vertex) ++offset_[v + 1];
  std::partial_sum(offset_.begin(), offset_.end(), offset_.begin());
  triangle_.resize(offset_.back());
  std::vector<int> end(offset_.begin(), offset_.end() - 1);
  for (int t = 0; t < mesh.n_triangles(); ++t)
    for (int v : mesh.triangle[t].vertex) triangle_[end[v]++] = t;
}

std::vector<double> targets_at_vertices(const FilmMesh& mesh, const TargetLength& target) {
  std::vector<double> length(mesh.n_vertices());
  for (int v = 0; v < mesh.n_vertices(); ++v) {
    length[v] = target(mesh.position[v]);
    expects(length[v] > 0, "target edge lengths are positive");
  }
  return length;
}

std::vector<EdgeLength> edges_below(const FilmMesh& mesh, const std::vector<double>& target_at_vertex,
                                    double fraction) {
  std::vector<EdgeLength> edges;
  for (const FilmTriangle& t : mesh.triangle)
    for (int c = 0; c < 3; ++c) {
      const auto [low, high] = std::minmax(t.vertex[c], t.vertex[(c + 1) % 3]);
      const double limit = fraction * 0.5 * (target_at_vertex[low] + target_at_vertex[high]);
      const double length_squared = norm_squared(mesh.edge(low, high));
      if (length_squared < limit * limit) edges.push_back({length_squared, low, high});
    }
  std::sort(edges.begin(), edges.end());
  edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
  return edges;
}

WorkingMesh::WorkingMesh(FilmMesh& film_mesh, int n_cut_vertices)
    : mesh(film_mesh),
      n_cut(n_cut_vertices),
      phases(film_mesh.n_vertices()),
      held(film_mesh.n_vertices(), 0) {
  std::fill_n(held.begin(), n_cut, 1);
  for (const FilmTriangle& t : mesh.triangle)
    for (int v : t.vertex) {
      phases[v].insert(t.phase_a);
      phases[v].insert(t.phase_b);
    }
  for (const MeshEdge& e : build_edges(mesh).edge)
    if (e.n_uses == 1) held[e.low] = held[e.high] = 1;
}

int WorkingMesh::add_vertex(const Vec3& position, const PhaseSet& vertex_phases, bool is_held) {
  mesh.position.push_back(position);
  phases.push_back(vertex_phases);
  held.push_back(is_held);
  return mesh.n_vertices() - 1;
}

void WorkingMesh::remove(const std::vector<char>& dead_triangle) {
  int n_kept = 0;
  for (int t = 0; t < mesh.n_triangles(); ++t)
    if (!dead_triangle[t]) mesh.triangle[n_kept++] = mesh.triangle[t];
  mesh.triangle.resize(n_kept);

  const std::vector<int> new_index = drop_unused_vertices(mesh);
  for (int v = 0; v < n_cut; ++v) expects(new_index[v] == v, "vertices on a cut keep their numbers");
  for (std::size_t v = 0; v < new_index.size(); ++v)
    if (new_index[v] >= 0) {
      phases[new_index[v]] = phases[v];
      held[new_index[v]] = held[v];
    }
  phases.resize(mesh.n_vertices());
  held.resize(mesh.n_vertices());
}

}  // namespace spume::mesh
