#include "spume/mesh/volume_constraint.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <vector>

#include "spume/base/error.hpp"
#include "spume/base/union_find.hpp"
#include "spume/mesh/measure.hpp"

namespace spume::mesh {
namespace {

constexpr double regularisation = 1e-3;  // of the least squares at a vertex, relative to the trace

int count_phases(const FilmMesh& mesh, std::span<const double> target) {
  int n_phases = std::max(1, static_cast<int>(target.size()));
  for (const FilmTriangle& t : mesh.triangle) n_phases = std::max(n_phases, t.phase_b + 1);
  return n_phases;
}

/// Phases whose constant is zero: the outside, those without a target, and the lowest phase of every group
/// that no film connects to one of these, for which the constants would be known up to a sum only.
std::vector<char> fixed_phases(const FilmMesh& mesh, std::span<const double> target, int n_phases) {
  std::vector<char> fixed(n_phases, 1);
  for (int p = 1; p < static_cast<int>(target.size()); ++p) fixed[p] = !(target[p] > 0);

  UnionFind group(n_phases);
  for (const FilmTriangle& t : mesh.triangle) group.join(t.phase_a, t.phase_b);
  std::vector<char> group_has_fixed(n_phases, 0);
  for (int p = 0; p < n_phases; ++p)
    if (fixed[p]) group_has_fixed[group.find(p)] = 1;
  for (int p = 0; p < n_phases; ++p)
    if (group.find(p) == p && !group_has_fixed[p]) fixed[p] = 1;
  return fixed;
}

/// The constants c of all phases [m]: Σ_j A_ij (c_i − c_j) = target_i − V_i for the phases that are not
/// fixed.
std::vector<double> phase_constants(const FilmMesh& mesh, std::span<const double> target,
                                    const std::vector<char>& fixed) {
  const int n_phases = static_cast<int>(fixed.size());
  const std::vector<double> volume = phase_volumes(mesh, n_phases);
  std::vector<int> unknown(n_phases, -1);
  int n_unknowns = 0;
  for (int p = 0; p < n_phases; ++p)
    if (!fixed[p]) unknown[p] = n_unknowns++;
  std::vector<double> constant(n_phases, 0.0);
  if (n_unknowns == 0) return constant;

  Eigen::MatrixXd laplacian = Eigen::MatrixXd::Zero(n_unknowns, n_unknowns);
  for (int t = 0; t < mesh.n_triangles(); ++t) {
    const double area = triangle_area(mesh, t);
    const int a = unknown[mesh.triangle[t].phase_a], b = unknown[mesh.triangle[t].phase_b];
    if (a >= 0) laplacian(a, a) += area;
    if (b >= 0) laplacian(b, b) += area;
    if (a >= 0 && b >= 0) {
      laplacian(a, b) -= area;
      laplacian(b, a) -= area;
    }
  }
  Eigen::VectorXd missing(n_unknowns);
  for (int p = 0; p < n_phases; ++p)
    if (unknown[p] >= 0) missing[unknown[p]] = target[p] - volume[p];
  const Eigen::VectorXd solution = laplacian.ldlt().solve(missing);
  if (!solution.allFinite())
    throw NumericalError("restoring the volumes: the displacements of the films have no finite solution");
  for (int p = 0; p < n_phases; ++p)
    if (unknown[p] >= 0) constant[p] = solution[unknown[p]];
  return constant;
}

/// Σ w n nᵀ, symmetric, and Σ w c n of a vertex.
struct NormalEquations {
  double xx = 0, yy = 0, zz = 0, xy = 0, xz = 0, yz = 0;
  Vec3 right;

  void add(double w, const Vec3& n, double wanted) {
    const Vec3 wn = w * n;
    xx += wn.x * n.x;
    yy += wn.y * n.y;
    zz += wn.z * n.z;
    xy += wn.x * n.y;
    xz += wn.x * n.z;
    yz += wn.y * n.z;
    right += wanted * wn;
  }
  /// By cofactors, with a multiple of the trace on the diagonal, without which two directions of a flat film
  /// would be free; zero for a vertex without films.
  Vec3 solution() const {
    const double trace = xx + yy + zz, r = regularisation * trace;
    if (!(trace > 0)) return {};
    const Vec3 a{xx + r, xy, xz}, b{xy, yy + r, yz}, c{xz, yz, zz + r};
    const Vec3 bc = cross(b, c);
    return (right.x * bc + right.y * cross(c, a) + right.z * cross(a, b)) / dot(a, bc);
  }
};

/// At each vertex the displacement x that minimises Σ A_t (n_t·x − (c_a − c_b))² over its triangles t.
std::vector<Vec3> displacements(const FilmMesh& mesh, const std::vector<double>& constant) {
  std::vector<NormalEquations> equations(mesh.n_vertices());
  for (int t = 0; t < mesh.n_triangles(); ++t) {
    const Vec3 doubled_normal = doubled_area_normal(mesh, t);
    const double weight = norm(doubled_normal);
    if (!(weight > 0)) continue;
    const double wanted = constant[mesh.triangle[t].phase_a] - constant[mesh.triangle[t].phase_b];
    for (int v : mesh.triangle[t].vertex) equations[v].add(weight, doubled_normal / weight, wanted);
  }
  std::vector<Vec3> displacement(mesh.n_vertices());
  for (int v = 0; v < mesh.n_vertices(); ++v) displacement[v] = equations[v].solution();
  return displacement;
}

}  // namespace

double restore_volumes(FilmMesh& mesh, std::span<const double> target, int iterations, double largest_step) {
  const std::vector<char> fixed = fixed_phases(mesh, target, count_phases(mesh, target));
  double largest = 0;
  for (int iteration = 0; iteration < iterations; ++iteration) {
    const std::vector<Vec3> displacement = displacements(mesh, phase_constants(mesh, target, fixed));
    for (int v = 0; v < mesh.n_vertices(); ++v) {
      const double length = norm(displacement[v]);
      const double step = std::min(length, largest_step);
      if (length > 0) mesh.position[v] += (step / length) * displacement[v];
      largest = std::max(largest, step);
    }
  }
  return largest;
}

}  // namespace spume::mesh
