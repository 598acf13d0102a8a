#include "spume/interface/curved_triangles.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "analytic_foams.hpp"

namespace spume::interface {
namespace {

/// Largest distance of the midpoints from a sphere, a radius.
double sphere_error(int levels) {
  const Vec3 centre{1e-3, -2e-3, 5e-4};
  const double radius = 8e-4;
  const auto films = testing::icosphere(centre, radius, levels);
  double error = 0;
  for (const auto& midpoints : edge_midpoints(films, mesh::build_topology(films)))
    for (const Vec3& m : midpoints) error = std::max(error, std::abs(norm(m - centre) / radius - 1));
  return error;
}

TEST(EdgeMidpoints, LieOnASphereToFourthOrder) {
  const double coarse = sphere_error(2), fine = sphere_error(3);
  // A straight midpoint is off by (ℓ/R)²/8 = 1e-2 on the coarse mesh.
  EXPECT_LT(coarse, 5e-4);
  EXPECT_NEAR(std::log2(coarse / fine), 4.0, 0.6);  // normals of an uneven mesh are not quite of third order
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
          if (a == c && b == d) EXPECT_LT(norm(midpoints[t][e] - midpoints[u][f]), 1e-15 * 5e-4 * 10);
        }
}

}  // namespace
}  // namespace spume::interface
