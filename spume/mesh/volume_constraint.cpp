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

/// At each vertex the displacement x that minimises Σ A_t (n_t·x − (c_a − c_b))² over its triangles t.
std::vector<Vec3> displacements(const FilmMesh& mesh, const std::vector<double>& constant) {
  std::vector<Eigen::Matrix3d> normal_matrix(mesh.n_vertices(), Eigen::Matrix3d::Zero());
  std::vector<Eigen::Vector3d> right_side(mesh.n_vertices(), Eigen::Vector3d::Zero());
  for (int t = 0; t < mesh.n_triangles(); ++t) {
    const Vec3 doubled_normal = doubled_area_normal(mesh, t);
    const double weight = norm(doubled_normal);
    if (!(weight > 0)) continue;
    const Vec3 unit = doubled_normal / weight;
    const Eigen::Vector3d n(unit.x, unit.y, unit.z);
    const double wanted = constant[mesh.triangle[t].phase_a] - constant[mesh.triangle[t].phase_b];
    for (int v : mesh.triangle[t].vertex) {
      normal_matrix[v] += weight * n * n.transpose();
      right_side[v] += weight * wanted * n;
    }
  }
  std::vector<Vec3> displacement(mesh.n_vertices());
  for (int v = 0; v < mesh.n_vertices(); ++v) {
    const double trace = normal_matrix[v].trace();
    if (!(trace > 0)) continue;
    normal_matrix[v].diagonal().array() += regularisation * trace;
    const Eigen::Vector3d x = normal_matrix[v].ldlt().solve(right_side[v]);
    displacement[v] = {x[0], x[1], x[2]};
  }
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
