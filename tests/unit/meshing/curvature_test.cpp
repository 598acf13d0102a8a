#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "spume/meshing/mesh_films.hpp"
#include "tests/support/film_shapes.hpp"

namespace spume {
namespace {

constexpr double radius = 2e-4;  // [m]

/// Largest |k R²/2 − 1| over film dofs of curved lamellae whose vertex is of the given kind.
double largest_error(const mesh::FilmMesh& films, mesh::VertexKind kind) {
  const mesh::Topology topology = mesh::build_topology(films);
  const std::vector<double> k = meshing::curvature_squared(films, topology);
  double largest = 0;
  for (std::size_t d = 0; d < k.size(); ++d) {
    const auto& dof = topology.film_dof[d];
    if (topology.lamella[dof.lamella].phase_a != 0 || topology.vertex_kind[dof.vertex] != kind) continue;
    largest = std::max(largest, std::abs(0.5 * k[d] * radius * radius - 1));
  }
  return largest;
}

double order(double coarse, double fine) {
  return std::log2(coarse / fine);
}

// x = (cosh v cos u, cosh v sin u, v), |v| ≤ 5/4, in units of `radius`; n rows of nearly equilateral
// triangles.
mesh::FilmMesh catenoid(int n) {
  const int around = static_cast<int>(std::lround(2 * std::numbers::pi * 1.4 * n / 2.5));
  mesh::FilmMesh films;
  for (int j = 0; j <= n; ++j)
    for (int i = 0; i < around; ++i) {
      const double v = -1.25 + 2.5 * j / n, u = 2 * std::numbers::pi * (i + 0.5 * (j % 2)) / around;
      films.position.push_back(radius * Vec3{std::cosh(v) * std::cos(u), std::cosh(v) * std::sin(u), v});
    }
  for (int j = 0; j < n; ++j)
    for (int i = 0; i < around; ++i) {
      const int a = j * around + i, b = j * around + (i + 1) % around, c = a + around, d = b + around;
      const int shift_low = j % 2 == 0 ? c : d, shift_high = j % 2 == 0 ? b : a;
      films.triangle.push_back(mesh::make_triangle(a, b, shift_low, 0, 1));
      films.triangle.push_back(mesh::make_triangle(shift_high, d, c, 0, 1));
    }
  return films;
}

struct CatenoidError {
  double inside, rim;
};

CatenoidError catenoid_error(int n) {
  const mesh::FilmMesh films = catenoid(n);
  const mesh::Topology topology = mesh::build_topology(films);
  const std::vector<double> k = meshing::curvature_squared(films, topology);
  CatenoidError error{0, 0};
  for (std::size_t d = 0; d < k.size(); ++d) {
    const double v = films.position[topology.film_dof[d].vertex].z / radius;
    const double exact = 2 / std::pow(std::cosh(v), 4);
    double& largest = std::abs(v) < 1 ? error.inside : error.rim;
    largest = std::max(largest, std::abs(k[d] * radius * radius - exact));
  }
  return error;
}

// The quadric misses the quartic part of a sphere: the relative error is about 1.6 (edge/R)². The edges of
// this mesh are R/6.5 to R/7.6, which makes 3.2 %; at R = 8 edges it is 2.5 %.
TEST(Curvature, OfASphereIsTwoOverRadiusSquared) {
  EXPECT_LT(largest_error(shapes::sphere({}, radius, 3, 1), mesh::VertexKind::Film), 0.035);
}

TEST(Curvature, OfASphereConvergesToSecondOrder) {
  const double e3 = largest_error(shapes::sphere({1e-3, 0, 0}, radius, 3, 1), mesh::VertexKind::Film);
  const double e4 = largest_error(shapes::sphere({1e-3, 0, 0}, radius, 4, 1), mesh::VertexKind::Film);
  EXPECT_GT(order(e3, e4), 1.7);
  EXPECT_LT(order(e3, e4), 2.3);
}

TEST(Curvature, OfCapsConvergesToSecondOrderAtTheirPlateauBorder) {
  const double coarse = largest_error(shapes::double_bubble(radius, 8), mesh::VertexKind::Border);
  const double fine = largest_error(shapes::double_bubble(radius, 16), mesh::VertexKind::Border);
  EXPECT_LT(coarse, 0.03);
  EXPECT_GT(order(coarse, fine), 1.7);
  EXPECT_LT(order(coarse, fine), 2.3);
}

TEST(Curvature, OfAFlatFilmIsZeroBesideCurvedOnes) {
  const mesh::FilmMesh films = shapes::double_bubble(radius, 8);
  const mesh::Topology topology = mesh::build_topology(films);
  const std::vector<double> k = meshing::curvature_squared(films, topology);
  int n_flat = 0;
  for (std::size_t d = 0; d < k.size(); ++d)
    if (topology.lamella[topology.film_dof[d].lamella].phase_a == 1) {
      ++n_flat;
      EXPECT_LT(k[d] * radius * radius, 1e-12);  // round-off of positions, squared
    }
  EXPECT_GT(n_flat, 100);
}

// The curvature of the catenoid varies: second order inside, where rings surround the vertex; first order at
// the open rim, where all neighbours are on one side.
TEST(Curvature, OfACatenoidConvergesToItsExactValue) {
  const CatenoidError coarse = catenoid_error(32), fine = catenoid_error(64);
  EXPECT_LT(fine.inside, 0.003);
  EXPECT_GT(order(coarse.inside, fine.inside), 1.7);
  EXPECT_LT(order(coarse.inside, fine.inside), 2.4);
  EXPECT_LT(fine.rim, 0.03);
  EXPECT_GT(order(coarse.rim, fine.rim), 0.8);
  EXPECT_LT(order(coarse.rim, fine.rim), 1.4);
}

// All points of one triangle, or of a strip with its vertices on a line, leave the quadric undetermined.
TEST(Curvature, OfFilmsTooNarrowToTellIsFiniteAndSmall) {
  mesh::FilmMesh films;
  for (int i = 0; i < 6; ++i) films.position.push_back(radius * Vec3{0.1 * i, i % 2 == 0 ? 0.0 : 1e-7, 0});
  for (int i = 0; i + 2 < 6; ++i)
    films.triangle.push_back(i % 2 == 0 ? mesh::make_triangle(i, i + 2, i + 1, 0, 1)
                                        : mesh::make_triangle(i, i + 1, i + 2, 0, 1));
  for (double k : meshing::curvature_squared(films, mesh::build_topology(films)))
    EXPECT_LT(k * radius * radius, 1e-6);
}

}  // namespace
}  // namespace spume
