#include "spume/meshing/figures.hpp"

#include <algorithm>

#include "spume/mesh/measure.hpp"
#include "spume/mesh/quality.hpp"
#include "spume/mesh/working_mesh.hpp"

namespace spume::meshing {

namespace {

void measure_shapes(const mesh::FilmMesh& films, MeshFigures& figures) {
  int n_round = 0;
  figures.smallest_radius_ratio = 1;
  for (int t = 0; t < films.n_triangles(); ++t) {
    const auto [a, b, c] = films.corners(t);
    const double ratio = radius_ratio(norm(c - b), norm(a - c), norm(b - a));
    n_round += ratio > 0.5;
    figures.smallest_radius_ratio = std::min(figures.smallest_radius_ratio, ratio);
  }
  figures.share_round = static_cast<double>(n_round) / films.n_triangles();
}

void measure_distances(const mesh::FilmMesh& films, const mesh::Topology& topology,
                       const mesh::Projection& project, MeshFigures& figures) {
  std::vector<char> drawn_together(films.n_vertices(), 0);
  for (int v : topology.junction)
    drawn_together[v] = topology.vertex_phases[v].size() > 4 ||
                        !project(films.position[v], topology.vertex_phases[v]).has_value();
  figures.n_drawn_together = static_cast<int>(std::count(drawn_together.begin(), drawn_together.end(), 1));
  const auto measure = [&](int v, const mesh::PhaseSet& phases, double& largest) {
    if (const auto there = project(films.position[v], phases))
      largest = std::max(largest, norm(films.domain.step(films.position[v], *there)));
    else
      ++figures.n_unprojected;
  };
  for (const mesh::FilmDof& dof : topology.film_dof) {
    const auto& lamella = topology.lamella[dof.lamella];
    measure(dof.vertex, {lamella.phase_a, lamella.phase_b},
            drawn_together[dof.vertex] ? figures.drawn_together_distance : figures.film_distance);
  }
  for (const mesh::BorderDof& dof : topology.border_dof) {
    const auto& p = topology.border[dof.border].phases;
    if (!drawn_together[dof.vertex]) measure(dof.vertex, {p[0], p[1], p[2]}, figures.border_distance);
  }
}

}  // namespace

double radius_ratio(double a, double b, double c) {
  const double product = a * b * c;
  return product > 0 ? (b + c - a) * (c + a - b) * (a + b - c) / product : 0;
}

int count_turned(const mesh::FilmMesh& films, const mesh::Topology& topology) {
  const std::vector<Vec3> around = mesh::film_dof_normals(films, topology);
  std::vector<char> turned(films.n_triangles(), 0);
  for (int t = 0; t < films.n_triangles(); ++t) {
    Vec3 mean;
    for (int dof : topology.corner_dof[t]) mean += around[dof];
    turned[t] = dot(mesh::doubled_area_normal(films, t), mean) <= 0;
  }
  const mesh::EdgeTable edges = mesh::build_edges(films);
  for (const mesh::MeshEdge& e : edges.edge) {
    if (e.n_uses != 2) continue;
    const int left = edges.use[e.first_use].triangle, right = edges.use[e.first_use + 1].triangle;
    if (topology.triangle_lamella[left] != topology.triangle_lamella[right]) continue;
    if (dot(mesh::doubled_area_normal(films, left), mesh::doubled_area_normal(films, right)) <= 0)
      turned[left] = turned[right] = 1;
  }
  return static_cast<int>(std::count(turned.begin(), turned.end(), 1));
}

MeshFigures figures_of(const mesh::FilmMesh& films, const mesh::Topology& topology,
                       const mesh::Projection& project) {
  const mesh::Quality quality = mesh::measure_quality(films, topology);
  MeshFigures figures;
  figures.n_triangles = films.n_triangles();
  figures.n_nonconforming_edges = topology.n_nonconforming_edges;
  figures.n_turned = count_turned(films, topology);
  figures.smallest_angle_degrees = quality.smallest_angle_degrees;
  figures.median_angle_degrees = quality.median_angle_degrees;
  measure_shapes(films, figures);
  measure_distances(films, topology, project, figures);
  return figures;
}

}  // namespace spume::meshing
