#include "spume/interface/relax.hpp"

#include <Eigen/IterativeLinearSolvers>
#include <Eigen/SparseCore>
#include <algorithm>
#include <array>
#include <cmath>

#include "spume/base/error.hpp"
#include "spume/mesh/measure.hpp"
#include "spume/mesh/phase_frames.hpp"
#include "spume/mesh/volume_constraint.hpp"

namespace spume::interface {

namespace {

using SparseMatrix = Eigen::SparseMatrix<double>;

/// The linear system of a step for displacements.
struct ImplicitStep {
  SparseMatrix matrix;              ///< M/τ + L
  std::vector<Vec3> straightening;  ///< −L x [m]
};

/// Lumped areas over τ, and the cotangent matrix of all films. The cotangents of a sliver would otherwise
/// rule the whole step; they are scaled down together until none exceeds 20.
ImplicitStep implicit_step(const mesh::FilmMesh& films, double tau) {
  constexpr double largest_cotangent = 20;
  const int n = films.n_vertices();
  ImplicitStep step{SparseMatrix(n, n), std::vector<Vec3>(n)};
  Eigen::VectorXd diagonal = Eigen::VectorXd::Zero(n);  // entry by entry it would be half of the work
  std::vector<Eigen::Triplet<double>> entries;
  entries.reserve(6 * films.triangle.size() + n);
  for (int t = 0; t < films.n_triangles(); ++t) {
    const auto& v = films.triangle[t].vertex;
    const double doubled_area = norm(mesh::doubled_area_normal(films, t));
    for (int c = 0; c < 3; ++c) diagonal(v[c]) += doubled_area / (6 * tau);
    if (doubled_area == 0) continue;
    std::array<double, 3> cotangent;  // of the corner opposite to the side c
    double largest = 0;
    for (int c = 0; c < 3; ++c) {
      const int apex = v[(c + 2) % 3];
      cotangent[c] = dot(films.edge(apex, v[c]), films.edge(apex, v[(c + 1) % 3])) / doubled_area;
      largest = std::max(largest, std::abs(cotangent[c]));
    }
    // All three by one factor: clipped one by one they would no longer be a positive matrix.
    const double scale = largest > largest_cotangent ? largest_cotangent / largest : 1;
    for (int c = 0; c < 3; ++c) {
      const int i = v[c], j = v[(c + 1) % 3];
      const double weight = 0.5 * scale * cotangent[c];
      diagonal(i) += weight;
      diagonal(j) += weight;
      entries.emplace_back(i, j, -weight);
      entries.emplace_back(j, i, -weight);
      const Vec3 pull = weight * films.edge(i, j);
      step.straightening[i] += pull;
      step.straightening[j] -= pull;
    }
  }
  for (int v = 0; v < n; ++v) entries.emplace_back(v, v, diagonal(v));
  step.matrix.setFromTriplets(entries.begin(), entries.end());
  return step;
}

void move_vertices(const ImplicitStep& step, const std::vector<Vec3>& push, mesh::FilmMesh& films) {
  Eigen::ConjugateGradient<SparseMatrix, Eigen::Lower | Eigen::Upper> solver(step.matrix);
  solver.setTolerance(1e-6);  // of displacements, which are small themselves
  solver.setMaxIterations(2000);
  const int n = films.n_vertices();
  for (int axis = 0; axis < 3; ++axis) {
    Eigen::VectorXd right(n);
    for (int v = 0; v < n; ++v) right(v) = step.straightening[v][axis] + push[v][axis];
    const Eigen::VectorXd displacement = solver.solve(right);
    if (solver.info() != Eigen::Success || !displacement.allFinite())
      throw NumericalError(
          "relaxation of the films failed: the linear system of a step has no usable solution");
    for (int v = 0; v < n; ++v) films.position[v][axis] += displacement(v);
  }
}

}  // namespace

RelaxStepReport relax_step(mesh::FilmMesh& films, const state::Phases& phases, double tau) {
  return relax_step(films, mesh::build_topology(films), phases, tau);
}

RelaxStepReport relax_step(mesh::FilmMesh& films, const mesh::Topology& topology, const state::Phases& phases,
                           double tau) {
  RelaxStepReport report{};
  report.area_before = mesh::film_area(films);
  const auto pressure = mesh::film_pressures(films, topology, mesh::area_descent(films), phases.count());
  const auto volume = mesh::phase_volumes(films, phases.count());
  if (mesh::stands_free(films, phases.count())) {
    double work = 0;
    for (int p = 1; p < phases.count(); ++p) work += pressure[p] * volume[p];
    report.virial_error = std::abs(2.0 / 3.0 * report.area_before / work - 1);
  }

  const std::vector<Vec3> before = films.position;
  move_vertices(implicit_step(films, tau), mesh::weighted_volume_gradient(films, pressure), films);
  mesh::restore_volumes(films, phases.target_volume, 2, std::sqrt(tau));

  report.largest_displacement = mesh::largest_distance(films.position, before);
  report.area_after = mesh::film_area(films);
  return report;
}

}  // namespace spume::interface
