#include "spume/transport/film_gradient.hpp"

#include <cmath>

#include "spume/mesh/measure.hpp"

namespace spume::transport {

namespace {

/// The normal equations Σ r rᵀ g = Σ r Δf of one dof, weighted.
struct NormalEquations {
  double xx = 0, xy = 0, xz = 0, yy = 0, yz = 0, zz = 0;
  Vec3 right;

  void add(const Vec3& r, double difference) {
    const double weight = 1 / norm_squared(r);
    xx += weight * r.x * r.x;
    xy += weight * r.x * r.y;
    xz += weight * r.x * r.z;
    yy += weight * r.y * r.y;
    yz += weight * r.y * r.z;
    zz += weight * r.z * r.z;
    right += (weight * difference) * r;
  }
  Vec3 times(const Vec3& v) const {
    return {xx * v.x + xy * v.y + xz * v.z, xy * v.x + yy * v.y + yz * v.z, xz * v.x + yz * v.y + zz * v.z};
  }
};

Vec3 solve_in_plane(const NormalEquations& equations, const Vec3& normal) {
  const Vec3 axis = std::abs(normal.x) < 0.6 ? Vec3{1, 0, 0} : Vec3{0, 1, 0};
  const Vec3 u = normalized(cross(normal, axis));
  const Vec3 v = cross(normal, u);
  const double uu = dot(u, equations.times(u)), uv = dot(u, equations.times(v)),
               vv = dot(v, equations.times(v));
  const double determinant = uu * vv - uv * uv;
  // Edges (nearly) in one line give no gradient across it.
  if (!(determinant > 0.02 * uu * vv)) return {};
  const double ru = dot(u, equations.right), rv = dot(v, equations.right);
  return ((vv * ru - uv * rv) / determinant) * u + ((uu * rv - uv * ru) / determinant) * v;
}

}  // namespace

std::vector<Vec3> film_gradient(const LiquidMesh& mesh, std::span<const double> value) {
  std::vector<NormalEquations> equations(value.size());
  for (const auto& dof : mesh.topology.corner_dof)
    for (int corner = 0; corner < 3; ++corner) {
      const int i = dof[corner], j = dof[(corner + 1) % 3];
      const Vec3 r = mesh.films.domain.step(mesh.film_position(i), mesh.film_position(j));
      if (norm_squared(r) == 0) continue;
      equations[i].add(r, value[j] - value[i]);
      equations[j].add(-r, value[i] - value[j]);
    }
  const std::vector<Vec3> normals = mesh::film_dof_normals(mesh.films, mesh.topology);
  std::vector<Vec3> gradient(value.size());
  for (std::size_t d = 0; d < value.size(); ++d) gradient[d] = solve_in_plane(equations[d], normals[d]);
  return gradient;
}

}  // namespace spume::transport
