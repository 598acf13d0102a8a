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
    const auto& corner = mesh.triangle[t].vertex;
    const Vec3 centroid =
        (mesh.position[corner[0]] + mesh.position[corner[1]] + mesh.position[corner[2]]) / 3.0;
    const double area = triangle_area(mesh, t);
    for (int v : corner)
      if (work.kind(v) == VertexKind::Film) mean[v].add(centroid, area);
  }
  for (const MeshEdge& e : build_edges(mesh).edge) {
    if (e.n_uses != 3) continue;
    const Vec3 a = mesh.position[e.low], b = mesh.position[e.high];
    for (int v : {e.low, e.high})
      if (work.kind(v) == VertexKind::Border) mean[v].add(0.5 * (a + b), norm(b - a));
  }
  for (int v = 0; v < mesh.n_vertices(); ++v) {
    if (work.held[v] || !(mean[v].weight > 0)) continue;
    const Vec3 wanted = mean[v].sum / mean[v].weight;
    const Vec3 moved = mesh.position[v] + relaxation * (wanted - mesh.position[v]);
    mesh.position[v] = project(moved, work.phases[v]).value_or(mesh.position[v]);
  }
}

}  // namespace spume::mesh
