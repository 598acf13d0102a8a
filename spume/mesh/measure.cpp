#include "spume/mesh/measure.hpp"

#include <Eigen/Dense>
#include <algorithm>

#include "spume/base/union_find.hpp"
#include "spume/mesh/phase_frames.hpp"

namespace spume::mesh {

namespace {

/// Gives every group of phases that films connect to each other, but not to the outside, the mean pressure
/// zero by volume.
void centre_groups_without_outside(const FilmMesh& mesh, std::vector<double>& pressure) {
  const int n_phases = static_cast<int>(pressure.size());
  UnionFind groups(n_phases);
  for (const auto& t : mesh.triangle) groups.join(t.phase_a, t.phase_b);
  std::vector<char> has_films(n_phases, 0);
  for (const auto& t : mesh.triangle) has_films[t.phase_a] = has_films[t.phase_b] = 1;
  const auto counts = [&](Phase p) { return has_films[p] && groups.find(p) != 0; };
  bool any = false;
  for (Phase p = 1; p < n_phases; ++p) any = any || counts(p);
  if (!any) return;

  const std::vector<double> volume = phase_volumes(mesh, n_phases);
  std::vector<double> work(n_phases, 0.0), size(n_phases, 0.0);
  for (Phase p = 1; p < n_phases; ++p) {
    if (!counts(p)) continue;
    work[groups.find(p)] += volume[p] * pressure[p];
    size[groups.find(p)] += volume[p];
  }
  for (Phase p = 1; p < n_phases; ++p)
    if (counts(p)) pressure[p] -= work[groups.find(p)] / size[groups.find(p)];
}

}  // namespace

double largest_distance(std::span<const Vec3> a, std::span<const Vec3> b) {
  double largest = 0;
  for (std::size_t n = 0; n < a.size(); ++n) largest = std::max(largest, norm(a[n] - b[n]));
  return largest;
}

double film_area(const FilmMesh& mesh) {
  double area = 0;
  for (int t = 0; t < mesh.n_triangles(); ++t) area += triangle_area(mesh, t);
  return area;
}

std::vector<double> phase_volumes(const FilmMesh& mesh, int n_phases) {
  const PhaseFrames frames(mesh, n_phases);
  std::vector<double> volume(n_phases, 0.0);
  for (int t = 0; t < mesh.n_triangles(); ++t) {
    const auto& [v, a, b] = mesh.triangle[t];
    const Vec3 first = mesh.edge(v[0], v[1]), second = mesh.edge(v[0], v[2]),
               area = 0.5 * cross(first, second),
               centroid = mesh.position[v[0]] + (1.0 / 3) * (first + second);
    volume[a] += frames.cone(a, centroid, area);
    volume[b] -= frames.cone(b, centroid, area);
  }
  volume[0] = 0;
  for (Phase p = 1; p < n_phases; ++p) volume[0] -= volume[p] = frames.volume(p, volume[p]);
  return volume;
}

std::vector<double> phase_areas(const FilmMesh& mesh, int n_phases) {
  std::vector<double> area(n_phases, 0.0);
  for (int t = 0; t < mesh.n_triangles(); ++t) {
    const double a = triangle_area(mesh, t);
    area[mesh.triangle[t].phase_a] += a;
    area[mesh.triangle[t].phase_b] += a;
  }
  return area;
}

std::vector<double> lamella_areas(const FilmMesh& mesh, const Topology& topology) {
  std::vector<double> area(topology.lamella.size(), 0.0);
  for (int t = 0; t < mesh.n_triangles(); ++t) area[topology.triangle_lamella[t]] += triangle_area(mesh, t);
  return area;
}

std::vector<double> film_dof_areas(const FilmMesh& mesh, const Topology& topology) {
  std::vector<double> area(topology.film_dof.size(), 0.0);
  for (int t = 0; t < mesh.n_triangles(); ++t) {
    const double third = triangle_area(mesh, t) / 3;
    for (int dof : topology.corner_dof[t]) area[dof] += third;
  }
  return area;
}

std::vector<double> border_dof_lengths(const FilmMesh& mesh, const Topology& topology) {
  std::vector<double> length(topology.border_dof.size(), 0.0);
  for (const auto& edge : topology.border_edge) {
    const double half = 0.5 * norm(mesh.edge(edge.vertex[0], edge.vertex[1]));
    for (int dof : edge.border_dof) length[dof] += half;
  }
  return length;
}

std::vector<double> border_lengths(const FilmMesh& mesh, const Topology& topology) {
  std::vector<double> length(topology.border.size(), 0.0);
  for (const auto& edge : topology.border_edge)
    length[edge.border] += norm(mesh.edge(edge.vertex[0], edge.vertex[1]));
  return length;
}

std::vector<Vec3> film_dof_normals(const FilmMesh& mesh, const Topology& topology) {
  std::vector<Vec3> normal(topology.film_dof.size());
  for (int t = 0; t < mesh.n_triangles(); ++t) {
    const Vec3 n = doubled_area_normal(mesh, t);
    for (int dof : topology.corner_dof[t]) normal[dof] += n;
  }
  for (auto& n : normal) n = normalized(n);
  return normal;
}

std::vector<Vec3> doubled_vertex_normals(const FilmMesh& mesh) {
  std::vector<Vec3> sum(mesh.position.size());
  for (int t = 0; t < mesh.n_triangles(); ++t) {
    const Vec3 normal = doubled_area_normal(mesh, t);
    for (int v : mesh.triangle[t].vertex) sum[v] += normal;
  }
  return sum;
}

std::vector<Vec3> border_tangents(const FilmMesh& mesh, const Topology& topology) {
  constexpr double least_sum = 0.5;  // of the directions of two edges in a row
  std::vector<Vec3> sum(mesh.position.size());
  std::vector<int> n_edges(mesh.position.size(), 0);
  for (const auto& border : topology.border)
    for (std::size_t n = 1; n < border.vertices.size(); ++n) {
      const int from = border.vertices[n - 1], to = border.vertices[n];
      const Vec3 along = normalized(mesh.edge(from, to));
      for (int v : {from, to}) {
        sum[v] += along;
        ++n_edges[v];
      }
    }
  for (std::size_t v = 0; v < sum.size(); ++v)
    sum[v] = n_edges[v] == 2 && norm(sum[v]) > least_sum ? normalized(sum[v]) : Vec3{};
  return sum;
}

std::vector<Vec3> area_descent(const FilmMesh& mesh) {
  std::vector<Vec3> descent(mesh.position.size());
  for (int t = 0; t < mesh.n_triangles(); ++t) {
    const Vec3 n = normalized(doubled_area_normal(mesh, t));
    const auto& v = mesh.triangle[t].vertex;
    for (int c = 0; c < 3; ++c) {
      const Vec3 opposite_edge = mesh.edge(v[(c + 1) % 3], v[(c + 2) % 3]);
      descent[v[c]] -= 0.5 * cross(n, opposite_edge);
    }
  }
  return descent;
}

std::vector<Vec3> weighted_volume_gradient(const FilmMesh& mesh, std::span<const double> value_of_phase) {
  std::vector<Vec3> gradient(mesh.position.size());
  for (int t = 0; t < mesh.n_triangles(); ++t) {
    const auto& triangle = mesh.triangle[t];
    const double jump = value_of_phase[triangle.phase_a] - value_of_phase[triangle.phase_b];
    const Vec3 share = (jump / 6) * doubled_area_normal(mesh, t);
    for (int v : triangle.vertex) gradient[v] += share;
  }
  return gradient;
}

std::vector<double> film_pressures(const FilmMesh& mesh, const VertexTopology& topology,
                                   std::span<const Vec3> force, int n_phases) {
  const std::vector<Vec3> doubled_area = doubled_vertex_normals(mesh);
  // Row and column of the outside are written too and left out of the solve.
  Eigen::MatrixXd laplacian = Eigen::MatrixXd::Zero(n_phases, n_phases);
  Eigen::VectorXd right = Eigen::VectorXd::Zero(n_phases);
  for (int v = 0; v < mesh.n_vertices(); ++v) {
    if (topology.vertex_kind[v] != VertexKind::Film || topology.vertex_phases[v].size() != 2) continue;
    const int a = topology.vertex_phases[v][0], b = topology.vertex_phases[v][1];
    const double weight = norm(doubled_area[v]) / 6;  // N·∂V/∂x of the vertex
    const double push = dot(normalized(doubled_area[v]), force[v]);
    laplacian(a, a) += weight;
    laplacian(b, b) += weight;
    laplacian(a, b) -= weight;
    laplacian(b, a) -= weight;
    right(a) -= push;
    right(b) += push;
  }
  for (int p = 1; p < n_phases; ++p)
    if (laplacian(p, p) == 0) laplacian(p, p) = 1;  // no film: pressure 0

  std::vector<double> pressure(n_phases, 0.0);
  if (n_phases > 1) {
    const int n = n_phases - 1;
    const Eigen::VectorXd solution =
        laplacian.bottomRightCorner(n, n).completeOrthogonalDecomposition().solve(right.tail(n));
    for (int p = 1; p < n_phases; ++p) pressure[p] = solution(p - 1);
  }
  centre_groups_without_outside(mesh, pressure);
  return pressure;
}

}  // namespace spume::mesh
