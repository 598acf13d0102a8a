#include "spume/mesh/quality.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include "spume/base/contract.hpp"
#include "spume/mesh/measure.hpp"

namespace spume::mesh {
namespace {

double angle_between(const Vec3& u, const Vec3& v) {
  return std::atan2(norm(cross(u, v)), dot(u, v));
}

double smallest_angle(const Vec3& a, const Vec3& b, const Vec3& c) {
  return std::min({angle_between(b - a, c - a), angle_between(c - b, a - b), angle_between(a - c, b - c)});
}

}  // namespace

Quality measure_quality(const FilmMesh& mesh, const Topology& topology) {
  expects(mesh.n_triangles() > 0, "the quality of a mesh without triangles is not defined");
  const std::vector<Vec3> dof_normal = film_dof_normals(mesh, topology);
  std::vector<double> angle(mesh.n_triangles());
  Quality quality{0, 0, std::numeric_limits<double>::infinity(), 0, 0};
  for (int t = 0; t < mesh.n_triangles(); ++t) {
    const auto [a, b, c] = mesh.corners(t);
    angle[t] = smallest_angle(a, b, c) * 180 / std::numbers::pi;
    for (double length : {norm(b - a), norm(c - b), norm(a - c)}) {
      quality.shortest_edge = std::min(quality.shortest_edge, length);
      quality.longest_edge = std::max(quality.longest_edge, length);
    }
    Vec3 mean_normal;
    for (int dof : topology.corner_dof[t]) mean_normal += dof_normal[dof];
    quality.n_inverted += dot(doubled_area_normal(mesh, t), mean_normal) < 0;
  }
  std::nth_element(angle.begin(), angle.begin() + angle.size() / 2, angle.end());
  quality.median_angle_degrees = angle[angle.size() / 2];
  quality.smallest_angle_degrees = *std::min_element(angle.begin(), angle.end());
  return quality;
}

}  // namespace spume::mesh
