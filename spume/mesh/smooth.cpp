#include "spume/mesh/smooth.hpp"

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
  for (const MeshEdge& e : build_edges(mesh).edge) {
    if (e.n_uses != 3) continue;
    const Vec3 along = mesh.edge(e.low, e.high);
    if (work.kind(e.low) == VertexKind::Border)
      mean[e.low].add(mesh.position[e.low] + 0.5 * along, norm(along));
    if (work.kind(e.high) == VertexKind::Border)
      mean[e.high].add(mesh.position[e.high] - 0.5 * along, norm(along));
  }
  for (int v = 0; v < mesh.n_vertices(); ++v) {
    if (work.held[v] || !(mean[v].weight > 0)) continue;
    const Vec3 wanted = mean[v].sum / mean[v].weight;
    const Vec3 moved = mesh.position[v] + relaxation * (wanted - mesh.position[v]);
    mesh.position[v] = project(moved, work.phases[v]).value_or(mesh.position[v]);
  }
}

}  // namespace spume::mesh
