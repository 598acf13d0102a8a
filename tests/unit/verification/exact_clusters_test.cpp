#include "spume/verification/exact_clusters.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "spume/mesh/measure.hpp"
#include "tests/support/film_shapes.hpp"

namespace spume::verification {
namespace {

using std::numbers::pi;

TEST(EqualCluster, of_one_is_a_sphere_and_of_two_the_standard_double_bubble) {
  EXPECT_NEAR(equal_cluster(1).area, 4 * pi, 1e-14);
  EXPECT_NEAR(equal_cluster(1).volume, 4 * pi / 3, 1e-14);
  EXPECT_NEAR(equal_cluster(2).area, 27 * pi / 4, 1e-13);
  EXPECT_NEAR(equal_cluster(2).volume, 9 * pi / 8, 1e-14);
  EXPECT_NEAR(equal_cluster(2).outer_border, std::sqrt(3.0) * pi, 1e-14);
}

// Volumes by sampling the union of the three or four unit spheres on a lattice: independent of the virial
// identity and of Gauss and Bonnet. The error of counting falls faster than the spacing, to below 1e-4 here.
double volume_by_counting(int n) {
  const auto centre = equal_cluster_centres(n);
  const int cells = 240;
  const double reach = 1.7, d = 2 * reach / cells;
  long inside = 0;
  for (int k = 0; k < cells; ++k)
    for (int j = 0; j < cells; ++j)
      for (int i = 0; i < cells; ++i) {
        const Vec3 x{-reach + (i + 0.31) * d, -reach + (j + 0.57) * d,
                     -reach + (k + 0.74) * d};  // no symmetry
        for (const Vec3& c : centre)
          if (norm_squared(x - c) < 1) {
            ++inside;
            break;
          }
      }
  return static_cast<double>(inside) * d * d * d / n;
}

TEST(EqualCluster, volumes_are_those_of_overlapping_unit_spheres) {
  for (int n = 1; n <= 4; ++n)
    EXPECT_NEAR(volume_by_counting(n) / equal_cluster(n).volume, 1, 2e-4) << n << " bubbles";
}

TEST(EqualCluster, of_four_has_the_lengths_and_areas_of_a_fine_exact_mesh) {
  const EqualCluster exact = equal_cluster(4);
  EXPECT_NEAR(exact.inner_border, 5 * std::sqrt(6.0) / 12, 1e-14);
  EXPECT_NEAR(exact.area, shapes::four_bubble_area, 1e-8);
  EXPECT_NEAR(exact.volume, shapes::four_bubble_volume, 1e-8);
  // A mesh of edges 1/n lies inside the curved films by O(1/n²).
  const auto deviation = [&](int n) {
    const auto films = shapes::four_bubbles(1, n);
    const auto topology = mesh::build_topology(films);
    double length = 0;
    for (double l : mesh::border_lengths(films, topology)) length += l;
    EXPECT_EQ(topology.n_borders(), exact.n_inner_borders + exact.n_outer_borders);
    EXPECT_EQ(topology.n_lamellae(), exact.n_lamellae);
    EXPECT_EQ(topology.n_junctions(), exact.n_junctions);
    return std::pair{1 - mesh::film_area(films) / exact.area, 1 - length / exact.border_length()};
  };
  const auto [area_8, length_8] = deviation(8);
  const auto [area_16, length_16] = deviation(16);
  EXPECT_NEAR(std::log2(area_8 / area_16), 2, 0.1);
  EXPECT_NEAR(std::log2(length_8 / length_16), 2, 0.1);
}

TEST(EqualCluster, of_three_has_the_area_of_its_pieces) {
  // Areas by quadrature of the outer film over polar angle and azimuth around the axis through two centres.
  const EqualCluster exact = equal_cluster(3);
  EXPECT_NEAR(exact.inner_border, 2 * std::sqrt(2.0 / 3), 1e-14);
  const auto centre = equal_cluster_centres(3);
  const int n_polar = 1000, n_around = 2000;
  double cap = 0;
  for (int p = 0; p < n_polar; ++p)
    for (int a = 0; a < n_around; ++a) {
      const double theta = pi * (p + 0.5) / n_polar, phi = 2 * pi * (a + 0.5) / n_around;
      const Vec3 x =
          centre[0] + Vec3{std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi), std::cos(theta)};
      if (norm_squared(x - centre[1]) > 1 && norm_squared(x - centre[2]) > 1)
        cap += std::sin(theta) * (pi / n_polar) * (2 * pi / n_around);
    }
  const double flat = exact.area / 3 - cap;  // one flat film a bubble
  // The flat film is the part of the disc of radius sqrt(3)/2 beyond the chord at 1/(2 sqrt 3) from its
  // middle.
  const double r = std::sqrt(0.75), d = 1 / (2 * std::sqrt(3.0));
  const double disc_part = r * r * (pi - std::acos(d / r)) + d * std::sqrt(r * r - d * d);
  EXPECT_NEAR(flat, disc_part, 5e-3);
}

TEST(DoubleBubble, keeps_the_virial_identity_at_any_ratio) {
  for (const double r1 : {0.1, 0.4, 0.5, 0.7, 0.99, 1.0}) {
    const DoubleBubble b = double_bubble_of_radii(r1, 1);
    // p = 2T/r of the outer film; the septum's curvature is not used.
    EXPECT_NEAR((2 / r1 * b.volume_1 + 2 * b.volume_2) / (2.0 / 3 * b.area), 1, 1e-12) << r1;
  }
}

TEST(DoubleBubble, of_given_volumes_has_them) {
  const DoubleBubble b = double_bubble_of_volumes(0.5e-9, 1e-9);
  EXPECT_NEAR(b.volume_1 / 0.5e-9, 1, 1e-12);
  EXPECT_NEAR(b.volume_2 / 1e-9, 1, 1e-12);
  const DoubleBubble equal = double_bubble_of_volumes(2, 2);
  EXPECT_NEAR(equal.radius_1, equal_cluster(2).radius_for(2), 1e-9);
}

// The area changes with volume at the pressure of that bubble: dA = p dV / T.
TEST(DoubleBubble, area_grows_with_volume_by_the_pressure) {
  const double v1 = 0.5, v2 = 1, d = 1e-4;
  const DoubleBubble b = double_bubble_of_volumes(v1, v2);
  const double slope_1 =
      (double_bubble_of_volumes(v1 + d, v2).area - double_bubble_of_volumes(v1 - d, v2).area) / (2 * d);
  const double slope_2 =
      (double_bubble_of_volumes(v1, v2 + d).area - double_bubble_of_volumes(v1, v2 - d).area) / (2 * d);
  EXPECT_NEAR(slope_1, 2 / b.radius_1, 1e-6);
  EXPECT_NEAR(slope_2, 2 / b.radius_2, 1e-6);
}

}  // namespace
}  // namespace spume::verification
