#include "spume/fem/surface_laplacian.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>
#include <string>

#include "spume/base/error.hpp"

namespace spume::fem {
namespace {

struct Patch {
  std::vector<Vec3> position;
  std::vector<std::array<int, 3>> triangle;
};

/// n × n cells on [0, side]², inner vertices moved a little so that no angle is special.
Patch uneven_patch(double side, int n) {
  Patch patch;
  const double h = side / n;
  for (int j = 0; j <= n; ++j)
    for (int i = 0; i <= n; ++i) {
      const bool inside = i > 0 && j > 0 && i < n && j < n;
      const double dx = inside ? 0.2 * h * std::sin(3.0 * i + 5.0 * j) : 0;
      patch.position.push_back({i * h + dx, j * h - 0.7 * dx, 0});
    }
  const auto at = [n](int i, int j) { return i + (n + 1) * j; };
  for (int j = 0; j < n; ++j)
    for (int i = 0; i < n; ++i) {
      patch.triangle.push_back({at(i, j), at(i + 1, j), at(i + 1, j + 1)});
      patch.triangle.push_back({at(i, j), at(i + 1, j + 1), at(i, j + 1)});
    }
  return patch;
}

std::vector<double> stiffness_times(const SurfaceLaplacian& surface, const std::vector<double>& f) {
  std::vector<double> result(f.size(), 0.0);
  for (int i = 0; i < surface.size(); ++i)
    for (int e = surface.offset[i]; e < surface.offset[i + 1]; ++e)
      result[i] += surface.stiffness[e] * (f[surface.neighbour[e]] - f[i]);
  return result;
}

TEST(SurfaceLaplacian, is_exact_for_linear_functions_at_inner_vertices) {
  const double side = 1e-3;
  const int n = 6;
  const Patch patch = uneven_patch(side, n);
  const SurfaceLaplacian surface = assemble_surface_laplacian(patch.position, patch.triangle);
  std::vector<double> f;
  for (const Vec3& x : patch.position) f.push_back(2 * x.x - 3 * x.y);
  const std::vector<double> kf = stiffness_times(surface, f);
  for (int j = 1; j < n; ++j)
    for (int i = 1; i < n; ++i) EXPECT_NEAR(kf[i + (n + 1) * j], 0, 1e-14 * side);
}

TEST(SurfaceLaplacian, has_the_flux_through_the_boundary_as_its_natural_term) {
  // For f = x, (Kf)_i is the integral of φ_i ∂f/∂ν over the boundary: −1/2 of the neighbouring edges on x =
  // 0.
  const double side = 1e-3;
  const int n = 4;
  const Patch patch = uneven_patch(side, n);
  const SurfaceLaplacian surface = assemble_surface_laplacian(patch.position, patch.triangle);
  std::vector<double> f;
  for (const Vec3& x : patch.position) f.push_back(x.x);
  const std::vector<double> kf = stiffness_times(surface, f);
  const double h = side / n;
  for (int j = 1; j < n; ++j) {
    EXPECT_NEAR(kf[(n + 1) * j], -h, 1e-13 * h);
    EXPECT_NEAR(kf[n + (n + 1) * j], h, 1e-13 * h);
  }
}

TEST(SurfaceLaplacian, masses_add_up_to_the_area_and_the_stiffness_is_symmetric) {
  const Patch patch = uneven_patch(1e-3, 5);
  const SurfaceLaplacian surface = assemble_surface_laplacian(patch.position, patch.triangle);
  EXPECT_NEAR(std::accumulate(surface.mass.begin(), surface.mass.end(), 0.0), 1e-6, 1e-19);
  for (int i = 0; i < surface.size(); ++i)
    for (int e = surface.offset[i]; e < surface.offset[i + 1]; ++e) {
      const int j = surface.neighbour[e];
      int back = surface.offset[j];
      while (surface.neighbour[back] != i) ++back;
      EXPECT_EQ(surface.stiffness[e], surface.stiffness[back]);
    }
}

TEST(SurfaceLaplacian, says_where_a_triangle_has_no_area) {
  const std::vector<Vec3> position = {{0, 0, 0.25}, {1, 0, 0.25}, {2, 0, 0.25}};
  const std::vector<std::array<int, 3>> triangle = {{0, 1, 2}};
  try {
    assemble_surface_laplacian(position, triangle);
    FAIL() << "no error";
  } catch (const NumericalError& error) {
    EXPECT_NE(std::string(error.what()).find("0.25"), std::string::npos) << error.what();
  }
}

}  // namespace
}  // namespace spume::fem
