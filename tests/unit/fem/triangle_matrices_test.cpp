#include "spume/fem/triangle_matrices.hpp"

#include <gtest/gtest.h>

#include <numbers>

namespace spume::fem {
namespace {

// A general triangle of the size of a film triangle, in space. Its matrices have no scale but the area, so
// round-off is compared with 1e-14 times the entries.
const Vec3 a{1e-4, 2e-4, -1e-4}, b{2.5e-4, 1.7e-4, 0.2e-4}, c{1.2e-4, 3.9e-4, 0.6e-4};

TEST(TriangleMatrices, stiffness_is_symmetric_and_its_rows_sum_to_zero) {
  const TriangleMatrix k = triangle_stiffness(a, b, c);
  for (int i = 0; i < 3; ++i) {
    EXPECT_NEAR(k[i][0] + k[i][1] + k[i][2], 0, 1e-14);
    for (int j = 0; j < 3; ++j) EXPECT_EQ(k[i][j], k[j][i]);
  }
}

TEST(TriangleMatrices, stiffness_gives_the_exact_energy_of_a_linear_function) {
  // f = q·x has the surface gradient q − (q·n) n, so fᵀKf = area |q_s|².
  const Vec3 q{3, -2, 5};
  const Vec3 n = normalized(cross(b - a, c - a)), tangential = q - dot(q, n) * n;
  const double f[3] = {dot(q, a), dot(q, b), dot(q, c)};
  const TriangleMatrix k = triangle_stiffness(a, b, c);
  double energy = 0;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) energy += f[i] * k[i][j] * f[j];
  const double exact = triangle_area(a, b, c) * norm_squared(tangential);
  EXPECT_NEAR(energy, exact, 1e-13 * exact);
}

TEST(TriangleMatrices, stiffness_of_an_equilateral_triangle_is_half_the_cotangent_of_sixty_degrees) {
  const TriangleMatrix k = triangle_stiffness({0, 0, 0}, {1, 0, 0}, {0.5, std::numbers::sqrt3 / 2, 0});
  EXPECT_NEAR(k[0][1], -0.5 / std::numbers::sqrt3, 1e-15);
  EXPECT_NEAR(k[0][0], 1 / std::numbers::sqrt3, 1e-15);
}

TEST(TriangleMatrices, the_angle_opposite_to_an_edge_decides_its_entry) {
  // Right angle at the first corner: the edge between the other two does not couple.
  const TriangleMatrix k = triangle_stiffness({0, 0, 0}, {2, 0, 0}, {0, 1, 0});
  EXPECT_EQ(k[1][2], 0);
  EXPECT_NEAR(k[0][1], -0.25, 1e-15);  // ½ cot of the angle at the third corner, ½ · 1/2
  EXPECT_NEAR(k[0][2], -1.0, 1e-15);   // ½ cot of the angle at the second, ½ · 2
}

TEST(TriangleMatrices, masses_add_up_to_the_area_and_lumping_takes_row_sums) {
  const double area = triangle_area(a, b, c);
  const TriangleMatrix m = triangle_mass(area);
  for (int i = 0; i < 3; ++i)
    EXPECT_NEAR(m[i][0] + m[i][1] + m[i][2], lumped_triangle_mass(area), 1e-15 * area);
  EXPECT_NEAR(3 * lumped_triangle_mass(area), area, 1e-15 * area);
}

TEST(TriangleMatrices, consistent_mass_integrates_products_of_linear_functions) {
  // ∫ x² over the triangle (0,0) (1,0) (0,1) is 1/12.
  const TriangleMatrix m = triangle_mass(0.5);
  const double x[3] = {0, 1, 0};
  double integral = 0;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) integral += x[i] * m[i][j] * x[j];
  EXPECT_NEAR(integral, 1.0 / 12, 1e-16);
}

TEST(SegmentMatrices, integrate_linear_functions_exactly) {
  // On a segment of length 2: ∫ x² = 8/3 and ∫ (x')² = 2 for x from 0 to 2.
  const double h = segment_length({1, 1, 1}, {1, 3, 1});
  EXPECT_EQ(h, 2);
  const SegmentMatrix m = segment_mass(h), k = segment_stiffness(h);
  EXPECT_NEAR(4 * m[1][1], 8.0 / 3, 1e-15);
  EXPECT_NEAR(4 * k[1][1], 2, 1e-15);
  EXPECT_EQ(k[0][0] + k[0][1], 0);
  EXPECT_NEAR(m[0][0] + m[0][1], lumped_segment_mass(h), 1e-15);
}

}  // namespace
}  // namespace spume::fem
