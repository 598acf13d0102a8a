#include "spume/interface/step_in_advance.hpp"

#include <vector>

#include "spume/mesh/measure.hpp"

namespace spume::interface {

namespace {

bool is_film(const mesh::Topology& topology, int v) {
  return topology.vertex_kind[v] == mesh::VertexKind::Film;
}

/// Mean of linearly interpolated displacements over the star of each vertex, by area.
std::vector<Vec3> star_means(const mesh::FilmMesh& films, const std::vector<Vec3>& displacement) {
  std::vector<Vec3> sum(films.position.size());
  std::vector<double> weight(films.position.size(), 0.0);
  for (int t = 0; t < films.n_triangles(); ++t) {
    const auto& vertex = films.triangle[t].vertex;
    const double area = mesh::triangle_area(films, t);
    const Vec3 mean = (displacement[vertex[0]] + displacement[vertex[1]] + displacement[vertex[2]]) / 3;
    for (int v : vertex) {
      sum[v] += area * mean;
      weight[v] += area;
    }
  }
  for (std::size_t v = 0; v < sum.size(); ++v) sum[v] = weight[v] > 0 ? sum[v] / weight[v] : displacement[v];
  return sum;
}

}  // namespace

void step_in_advance(mesh::FilmMesh& films, const mesh::Topology& topology, double t, double spacing,
                     int n_phases) {
  std::vector<Vec3> force = mesh::area_descent(films);
  const std::vector<double> pressure = mesh::film_pressures(films, topology, force, n_phases);
  const std::vector<Vec3> push = mesh::weighted_volume_gradient(films, pressure);
  for (std::size_t v = 0; v < force.size(); ++v) force[v] += push[v];

  std::vector<double> area(films.position.size(), 0.0);
  std::vector<Vec3> normal(films.position.size());
  for (int n = 0; n < films.n_triangles(); ++n) {
    const Vec3 doubled = mesh::doubled_area_normal(films, n);
    for (int v : films.triangle[n].vertex) {
      area[v] += norm(doubled) / 6;
      normal[v] += doubled;
    }
  }
  const double smallest_area = 0.02 * spacing * spacing;  // keeps vertices of slivers from flying
  std::vector<Vec3> displacement(films.position.size());
  for (int v = 0; v < films.n_vertices(); ++v) {
    if (is_film(topology, v)) {
      const Vec3 n = normalized(normal[v]);
      force[v] = dot(force[v], n) * n;
    }
    displacement[v] = -t / (area[v] + smallest_area) * force[v];
    const double size = norm(displacement[v]);
    if (size > 0.1 * spacing) displacement[v] *= 0.1 * spacing / size;
  }
  const std::vector<Vec3> mean = star_means(films, displacement);
  for (int v = 0; v < films.n_vertices(); ++v)
    films.position[v] += is_film(topology, v) ? mean[v] : displacement[v];
}

}  // namespace spume::interface
