#include "spume/interface/curved_triangles.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "analytic_foams.hpp"

namespace spume::interface {
namespace {

constexpr double ring_radius = 8e-4, tube_radius = 4e-4;  // of a torus

/// A torus of phase 1 with n vertices around the tube: a smooth mesh of a film with two different curvatures.
mesh::FilmMesh torus(int n) {
  const int m = 3 * n;  // around the ring
  mesh::FilmMesh films;
  for (int i = 0; i < m; ++i)
    for (int j = 0; j < n; ++j) {
      const double around = 2 * std::numbers::pi * i / m, tube = 2 * std::numbers::pi * (j + 0.5 * i) / n;
      const double r = ring_radius + tube_radius * std::cos(tube);
      films.position.push_back({r * std::cos(around), r * std::sin(around), tube_radius * std::sin(tube)});
    }
  // 3n half steps of shift close up after an even n.
  const auto vertex = [&](int i, int j) { return i < m ? i * n + (j + n) % n : (j + 3 * n / 2 + n) % n; };
  for (int i = 0; i < m; ++i)
    for (int j = 0; j < n; ++j) {
      films.triangle.push_back(mesh::make_triangle(vertex(i, j), vertex(i + 1, j), vertex(i, j + 1), 1, 0));
      films.triangle.push_back(
          mesh::make_triangle(vertex(i, j), vertex(i + 1, j - 1), vertex(i + 1, j), 1, 0));
    }
  return films;
}

/// Largest distance of the midpoints from the torus, in radii of its tube.
double torus_error(int n) {
  const auto films = torus(n);
  const auto topology = mesh::build_topology(films);
  EXPECT_EQ(topology.n_nonconforming_edges, 0);
  double error = 0;
  for (const auto& midpoints : edge_midpoints(films, topology))
    for (const Vec3& x : midpoints)
      error =
          std::max(error, std::abs(std::hypot(std::hypot(x.x, x.y) - ring_radius, x.z) / tube_radius - 1));
  return error;
}

TEST(EdgeMidpoints, LieOnASmoothFilmToFourthOrder) {
  EXPECT_LT(torus_error(16), 2e-3);  // straight: 2e-2
  EXPECT_NEAR(std::log2(torus_error(16) / torus_error(32)), 4.0, 0.3);
}

/// Two caps and a disk on one ring of n vertices.
mesh::FilmMesh lens(int n, double radius) {
  mesh::FilmMesh films;
  for (int m = 0; m < n; ++m) {
    const double angle = 2 * std::numbers::pi * m / n;
    films.position.push_back({radius * std::cos(angle), radius * std::sin(angle), 0});
  }
  films.position.push_back({0, 0, radius});
  films.position.push_back({0, 0, -radius});
  films.position.push_back({0, 0, 0});
  for (int m = 0; m < n; ++m) {
    const int next = (m + 1) % n;
    films.triangle.push_back(mesh::make_triangle(m, next, n, 1, 0));
    films.triangle.push_back(mesh::make_triangle(next, m, n + 1, 2, 0));
    films.triangle.push_back(mesh::make_triangle(m, next, n + 2, 2, 1));
  }
  return films;
}

double ring_error(int n) {
  const double radius = 5e-4;
  const auto films = lens(n, radius);
  const auto topology = mesh::build_topology(films);
  const auto midpoints = edge_midpoints(films, topology);
  double error = 0;
  for (const auto& edge : topology.border_edge)
    for (int t : edge.triangle)
      for (int e = 0; e < 3; ++e)
        if (films.triangle[t].vertex[e] < n && films.triangle[t].vertex[(e + 1) % 3] < n)
          error = std::max(error, std::abs(norm(midpoints[t][e]) / radius - 1));
  return error;
}

TEST(EdgeMidpoints, OfAPlateauBorderLieOnItToFourthOrder) {
  EXPECT_LT(ring_error(16), 1e-3);  // straight: 1.9e-2
  EXPECT_NEAR(std::log2(ring_error(16) / ring_error(32)), 4.0, 0.1);
}

TEST(EdgeMidpoints, AreSharedByNeighbouringTriangles) {
  const auto films = lens(12, 5e-4);
  const auto midpoints = edge_midpoints(films, mesh::build_topology(films));
  for (int t = 0; t < films.n_triangles(); ++t)
    for (int e = 0; e < 3; ++e)
      for (int u = 0; u < films.n_triangles(); ++u)
        for (int f = 0; f < 3; ++f) {
          const auto [a, b] = std::minmax(films.triangle[t].vertex[e], films.triangle[t].vertex[(e + 1) % 3]);
          const auto [c, d] = std::minmax(films.triangle[u].vertex[f], films.triangle[u].vertex[(f + 1) % 3]);
          if (a != c || b != d) continue;
          EXPECT_LT(norm(midpoints[t][e] - midpoints[u][f]), 1e-14 * 5e-4);
        }
}

}  // namespace
}  // namespace spume::interface
