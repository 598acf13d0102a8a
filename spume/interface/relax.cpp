#include "spume/interface/relax.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <utility>
#include <vector>

#include "spume/base/error.hpp"
#include "spume/mesh/measure.hpp"
#include "spume/mesh/phase_frames.hpp"
#include "spume/mesh/volume_constraint.hpp"

namespace spume::interface {

namespace {

/// The linear system of a step for displacements, M/τ + L, by triangles, and −L x [m].
struct ImplicitStep {
  std::span<const mesh::FilmTriangle> triangle;
  std::vector<std::array<double, 3>> side;  ///< weights of their sides: minus their entries of the matrix
  std::vector<double> mass;                 ///< M/τ
  std::vector<double> diagonal;             ///< of the whole matrix
  std::vector<Vec3> straightening;

  int size() const { return static_cast<int>(diagonal.size()); }
};

/// Half the cotangents of the corners opposite to the sides ab, bc and ca of a triangle. The cotangents of a
/// sliver would otherwise rule the whole step; they are scaled down together, for clipped one by one they
/// would no longer be a positive matrix, until none exceeds 20.
std::array<double, 3> side_weights(const Vec3& ab, const Vec3& ac, double doubled_area) {
  constexpr double largest_cotangent = 20;
  if (doubled_area == 0) return {0, 0, 0};
  const double at_a = dot(ab, ac), at_b = norm_squared(ab) - at_a, at_c = norm_squared(ac) - at_a;
  const double largest = std::max({std::abs(at_a), std::abs(at_b), std::abs(at_c)});
  const double scale =
      largest > largest_cotangent * doubled_area ? 0.5 * largest_cotangent / largest : 0.5 / doubled_area;
  return {scale * at_c, scale * at_a, scale * at_b};
}

/// Lumped areas over τ, and the cotangent matrix of all films.
ImplicitStep implicit_step(const mesh::FilmMesh& films, double tau) {
  const int n = films.n_vertices();
  ImplicitStep step{films.triangle, std::vector<std::array<double, 3>>(films.triangle.size()),
                    std::vector<double>(n, 0.0), std::vector<double>(n, 0.0), std::vector<Vec3>(n)};
  for (int t = 0; t < films.n_triangles(); ++t) {
    const auto& [a, b, c] = films.triangle[t].vertex;
    const Vec3 ab = films.edge(a, b), ac = films.edge(a, c);
    const double doubled_area = norm(cross(ab, ac));
    const auto& [w_ab, w_bc, w_ca] = step.side[t] = side_weights(ab, ac, doubled_area);
    for (int v : {a, b, c}) step.mass[v] += doubled_area / (6 * tau);
    step.diagonal[a] += w_ab + w_ca;
    step.diagonal[b] += w_ab + w_bc;
    step.diagonal[c] += w_bc + w_ca;
    const Vec3 pull_ab = w_ab * ab, pull_bc = w_bc * (ac - ab), pull_ac = w_ca * ac;
    step.straightening[a] += pull_ab + pull_ac;
    step.straightening[b] += pull_bc - pull_ab;
    step.straightening[c] -= pull_bc + pull_ac;
  }
  for (int v = 0; v < n; ++v) step.diagonal[v] += step.mass[v];
  return step;
}

Vec3 products(const Vec3& a, const Vec3& b) {
  return {a.x * b.x, a.y * b.y, a.z * b.z};
}
/// a/b where b is not zero, and zero where it is: the direction is solved for already.
Vec3 quotients(const Vec3& a, const Vec3& b) {
  const auto quotient = [](double p, double q) { return q != 0 ? p / q : 0; };
  return {quotient(a.x, b.x), quotient(a.y, b.y), quotient(a.z, b.z)};
}

/// The matrix times `in`; gives the scalar products of both by direction. Triangle by triangle this costs as
/// much as row by row, and there is no matrix to be put together.
Vec3 apply(const ImplicitStep& step, const std::vector<Vec3>& in, std::vector<Vec3>& out) {
  for (int v = 0; v < step.size(); ++v) out[v] = step.mass[v] * in[v];
  for (std::size_t t = 0; t < step.triangle.size(); ++t) {
    const auto& [a, b, c] = step.triangle[t].vertex;
    const auto& [w_ab, w_bc, w_ca] = step.side[t];
    const Vec3 ab = w_ab * (in[b] - in[a]), bc = w_bc * (in[c] - in[b]), ca = w_ca * (in[a] - in[c]);
    out[a] += ca - ab;
    out[b] += ab - bc;
    out[c] += bc - ca;
  }
  Vec3 product;
  for (int v = 0; v < step.size(); ++v) product += products(out[v], in[v]);
  return product;
}

/// The solution for three right sides, x, y and z, by conjugate gradients with the diagonal as
/// preconditioner, all three at a time since most of the work is to fetch the matrix. The residual falls to
/// `tolerance` of the right sides.
std::vector<Vec3> solve(const ImplicitStep& step, std::vector<Vec3> residual, double tolerance) {
  constexpr int max_iterations = 2000;
  const int n = step.size();
  std::vector<Vec3> solution(n), direction(n), image(n);
  Vec3 wanted, descent;
  for (int v = 0; v < n; ++v) {
    direction[v] = step.diagonal[v] > 0 ? residual[v] / step.diagonal[v] : Vec3{};
    wanted += products(residual[v], residual[v]);
    descent += products(residual[v], direction[v]);
  }
  wanted *= tolerance * tolerance;
  for (int iteration = 0; iteration < max_iterations; ++iteration) {
    const Vec3 length = quotients(descent, apply(step, direction, image));
    Vec3 size, next_descent;
    for (int v = 0; v < n; ++v) {
      solution[v] += products(length, direction[v]);
      residual[v] -= products(length, image[v]);
      const Vec3 square = products(residual[v], residual[v]);
      size += square;
      if (step.diagonal[v] > 0) next_descent += square / step.diagonal[v];
    }
    if (size.x <= wanted.x && size.y <= wanted.y && size.z <= wanted.z) return solution;
    const Vec3 share = quotients(next_descent, descent);
    descent = next_descent;
    for (int v = 0; v < n; ++v) {
      direction[v] = products(share, direction[v]);
      if (step.diagonal[v] > 0) direction[v] += residual[v] / step.diagonal[v];
    }
  }
  throw NumericalError("relaxation of the films failed: the linear system of a step has no usable solution");
}

/// One step without restored volumes; gives the film pressures a unit of tension.
std::vector<double> move_vertices(mesh::FilmMesh& films, const mesh::VertexTopology& topology, int n_phases,
                                  double tau, double tolerance) {
  const ImplicitStep step = implicit_step(films, tau);
  const std::vector<double> pressure = mesh::film_pressures(films, topology, step.straightening, n_phases);
  std::vector<Vec3> right = mesh::weighted_volume_gradient(films, pressure);
  for (int v = 0; v < step.size(); ++v) right[v] += step.straightening[v];
  const std::vector<Vec3> displacement = solve(step, std::move(right), tolerance);
  for (int v = 0; v < step.size(); ++v) films.position[v] += displacement[v];
  return pressure;
}

}  // namespace

RelaxStepReport relax_step(mesh::FilmMesh& films, const mesh::VertexTopology& topology,
                           const state::Phases& phases, double tau, int volume_iterations) {
  constexpr double tolerance = 1e-6;  // of displacements, which are small themselves
  RelaxStepReport report{};
  report.area_before = mesh::film_area(films);
  const auto volume = mesh::phase_volumes(films, phases.count());
  const bool stands_free = mesh::stands_free(films, phases.count());
  const std::vector<Vec3> before = films.position;
  const auto pressure = move_vertices(films, topology, phases.count(), tau, tolerance);
  mesh::restore_volumes(films, phases.target_volume, volume_iterations, std::sqrt(tau));

  if (stands_free) {
    double work = 0;
    for (int p = 1; p < phases.count(); ++p) work += pressure[p] * volume[p];
    report.virial_error = std::abs(2.0 / 3.0 * report.area_before / work - 1);
  }
  report.largest_displacement = mesh::largest_distance(films.position, before);
  report.area_after = mesh::film_area(films);
  return report;
}

void relax_briefly(mesh::FilmMesh& films, const mesh::VertexTopology& topology, int n_phases, double tau,
                   int n_steps) {
  constexpr double tolerance = 1e-4;
  for (int n = 0; n < n_steps; ++n) move_vertices(films, topology, n_phases, tau / n_steps, tolerance);
}

}  // namespace spume::interface
