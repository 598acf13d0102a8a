#include "spume/interface/relax.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>
#include <vector>

#include "spume/base/error.hpp"
#include "spume/mesh/measure.hpp"
#include "spume/mesh/phase_frames.hpp"
#include "spume/mesh/volume_constraint.hpp"

namespace spume::interface {

namespace {

/// The linear system of a step for displacements: M/τ + L, and −L x [m].
struct ImplicitStep {
  std::vector<double> diagonal;
  std::vector<int> row;        ///< first entry of each vertex in the next two, and one past the last
  std::vector<int> neighbour;  ///< the other end of an edge
  std::vector<double> weight;  ///< of the edge: minus the entry of the matrix
  std::vector<Vec3> straightening;

  int size() const { return static_cast<int>(diagonal.size()); }
};

/// Half the cotangents of the corners opposite to the sides of a triangle. The cotangents of a sliver would
/// otherwise rule the whole step; they are scaled down together, for clipped one by one they would no longer
/// be a positive matrix, until none exceeds 20.
std::array<double, 3> side_weights(const mesh::FilmMesh& films, int t, double doubled_area) {
  constexpr double largest_cotangent = 20;
  if (doubled_area == 0) return {0, 0, 0};
  const auto corner = films.corners(t);
  std::array<double, 3> weight;
  double largest = 0;
  for (int c = 0; c < 3; ++c) {
    const Vec3& apex = corner[(c + 2) % 3];
    weight[c] = dot(corner[c] - apex, corner[(c + 1) % 3] - apex) / doubled_area;
    largest = std::max(largest, std::abs(weight[c]));
  }
  const double scale = 0.5 * (largest > largest_cotangent ? largest_cotangent / largest : 1);
  for (double& w : weight) w *= scale;
  return weight;
}

/// Lumped areas over τ, and the cotangent matrix of all films.
ImplicitStep implicit_step(const mesh::FilmMesh& films, const mesh::VertexTopology& topology, double tau) {
  const int n = films.n_vertices();
  std::vector<std::array<double, 3>> side(films.triangle.size());
  ImplicitStep step{std::vector<double>(n, 0.0), {0}, {}, {}, std::vector<Vec3>(n)};
  for (int t = 0; t < films.n_triangles(); ++t) {
    const double doubled_area = norm(mesh::doubled_area_normal(films, t));
    side[t] = side_weights(films, t, doubled_area);
    for (int v : films.triangle[t].vertex) step.diagonal[v] += doubled_area / (6 * tau);
  }
  step.neighbour.reserve(7 * static_cast<std::size_t>(n));
  step.weight.reserve(7 * static_cast<std::size_t>(n));
  for (int v = 0; v < n; ++v) {
    const std::size_t first = step.neighbour.size();
    const auto add = [&](int other, double weight) {
      const auto known = std::find(step.neighbour.begin() + first, step.neighbour.end(), other);
      if (known != step.neighbour.end()) {
        step.weight[known - step.neighbour.begin()] += weight;
      } else {
        step.neighbour.push_back(other);
        step.weight.push_back(weight);
      }
    };
    for (int m = topology.star_offset[v]; m < topology.star_offset[v + 1]; ++m) {
      const int t = topology.star_triangle[m];
      const auto& corner = films.triangle[t].vertex;
      const int c = corner[0] == v ? 0 : corner[1] == v ? 1 : 2;
      add(corner[(c + 1) % 3], side[t][c]);
      add(corner[(c + 2) % 3], side[t][(c + 2) % 3]);
    }
    for (std::size_t m = first; m < step.neighbour.size(); ++m) {
      step.diagonal[v] += step.weight[m];
      step.straightening[v] += step.weight[m] * films.edge(v, step.neighbour[m]);
    }
    step.row.push_back(static_cast<int>(step.neighbour.size()));
  }
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

/// The matrix times `in`; gives the scalar products of both by direction.
Vec3 apply(const ImplicitStep& step, const std::vector<Vec3>& in, std::vector<Vec3>& out) {
  Vec3 product;
  for (int v = 0; v < step.size(); ++v) {
    Vec3 sum = step.diagonal[v] * in[v];
    for (int m = step.row[v]; m < step.row[v + 1]; ++m) sum -= step.weight[m] * in[step.neighbour[m]];
    out[v] = sum;
    product += products(sum, in[v]);
  }
  return product;
}

/// The solution for three right sides, x, y and z, by conjugate gradients with the diagonal as
/// preconditioner, all three at a time since most of the work is to fetch the matrix.
std::vector<Vec3> solve(const ImplicitStep& step, std::vector<Vec3> residual) {
  constexpr double tolerance = 1e-6;  // of displacements, which are small themselves
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

void move_vertices(const ImplicitStep& step, const std::vector<Vec3>& push, mesh::FilmMesh& films) {
  std::vector<Vec3> right = step.straightening;
  for (int v = 0; v < step.size(); ++v) right[v] += push[v];
  const std::vector<Vec3> displacement = solve(step, std::move(right));
  for (int v = 0; v < step.size(); ++v) films.position[v] += displacement[v];
}

}  // namespace

RelaxStepReport relax_step(mesh::FilmMesh& films, const mesh::VertexTopology& topology,
                           const state::Phases& phases, double tau, int volume_iterations) {
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
  move_vertices(implicit_step(films, topology, tau), mesh::weighted_volume_gradient(films, pressure), films);
  mesh::restore_volumes(films, phases.target_volume, volume_iterations, std::sqrt(tau));

  report.largest_displacement = mesh::largest_distance(films.position, before);
  report.area_after = mesh::film_area(films);
  return report;
}

}  // namespace spume::interface
