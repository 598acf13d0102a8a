#include "spume/mesh/smooth.hpp"

#include <algorithm>
#include <array>
#include <vector>

namespace spume::mesh {
namespace {

constexpr double relaxation = 0.7;

struct WeightedMean {
  Vec3 sum;
  double weight = 0;

  void add(const Vec3& x, double w) {
    sum += w * x;
    weight += w;
  }
};

/// Edges on three triangles, low < high, in increasing order.
std::vector<std::array<int, 2>> border_edges(const WorkingMesh& work) {
  std::vector<std::array<int, 2>> side, edge;
  for (const FilmTriangle& t : work.mesh.triangle)
    for (int c = 0; c < 3; ++c) {
      const auto [low, high] = std::minmax(t.vertex[c], t.vertex[(c + 1) % 3]);
      if (work.kind(low) != VertexKind::Film && work.kind(high) != VertexKind::Film)
        side.push_back({low, high});
    }
  std::sort(side.begin(), side.end());
  for (std::size_t first = 0, last; first < side.size(); first = last) {
    last = first;
    while (last < side.size() && side[last] == side[first]) ++last;
    if (last - first == 3) edge.push_back(side[first]);
  }
  return edge;
}

}  // namespace

void smooth(WorkingMesh& work, const Projection& project) {
  FilmMesh& mesh = work.mesh;
  std::vector<WeightedMean> mean(mesh.n_vertices());
  for (int t = 0; t < mesh.n_triangles(); ++t) {
    const auto [a, b, c] = mesh.corners(t);
    const Vec3 centroid = (a + b + c) / 3.0;
    const double area = triangle_area(mesh, t);
    for (int v : mesh.triangle[t].vertex)
      if (work.kind(v) == VertexKind::Film) mean[v].add(mesh.domain.near(centroid, mesh.position[v]), area);
  }
  for (const auto& [low, high] : border_edges(work)) {
    const Vec3 along = mesh.edge(low, high);
    if (work.kind(low) == VertexKind::Border) mean[low].add(mesh.position[low] + 0.5 * along, norm(along));
    if (work.kind(high) == VertexKind::Border) mean[high].add(mesh.position[high] - 0.5 * along, norm(along));
  }
  for (int v = 0; v < mesh.n_vertices(); ++v) {
    if (work.held[v] || !(mean[v].weight > 0)) continue;
    const Vec3 wanted = mean[v].sum / mean[v].weight;
    const Vec3 moved = mesh.position[v] + relaxation * (wanted - mesh.position[v]);
    mesh.position[v] = project(moved, work.phases[v]).value_or(mesh.position[v]);
  }
}

}  // namespace spume::mesh
