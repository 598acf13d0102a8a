#include "spume/verification/film_angles.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "tests/support/film_shapes.hpp"

namespace spume::verification {
namespace {

constexpr double longest_edge = 2.243;  // of that mesh for n = 1: the outer borders

PlateauAngles of_exact(int n) {
  const auto films = shapes::four_bubbles(1, n);
  const double edge = longest_edge / n;
  return plateau_angles(films, mesh::build_topology(films), 4 * edge, edge);
}

// Films of the exact cluster are spheres and planes: a quadric over 4 edges leaves the cubic and quartic
// terms.
TEST(PlateauAngles, of_the_exact_cluster_are_right_and_converge) {
  const PlateauAngles coarse = of_exact(20), fine = of_exact(40);
  EXPECT_GT(coarse.n_film_angles, 100);
  EXPECT_GE(coarse.n_border_angles, 30);
  EXPECT_LT(fine.film_rms, 0.3);
  EXPECT_LT(fine.border_largest, 1e-6);  // borders are circles, whose chords a parabola through the end fits
  EXPECT_LT(fine.film_rms, 0.5 * coarse.film_rms);
}

// Stretching along one axis by 2 % turns a direction at 45° to it by 0.57°.
TEST(PlateauAngles, see_a_cluster_that_is_out_of_shape) {
  auto films = shapes::four_bubbles(1, 40);
  for (auto& x : films.position) x.z *= 1.02;
  const double edge = longest_edge / 40;
  const PlateauAngles angles = plateau_angles(films, mesh::build_topology(films), 4 * edge, edge);
  EXPECT_GT(angles.film_largest, 0.8);
  EXPECT_LT(angles.film_largest, 2.0);
  EXPECT_GT(angles.border_largest, 0.8);
}

TEST(PlateauAngles, of_a_closed_border_are_measured_all_around) {
  const auto films = shapes::double_bubble(1, 16);
  const double edge = 0.9 / 16;
  const auto topology = mesh::build_topology(films);
  const PlateauAngles angles = plateau_angles(films, topology, 4 * edge, edge);
  EXPECT_EQ(angles.n_film_angles, 3 * (6 * 16));
  EXPECT_EQ(angles.n_border_angles, 0);
  EXPECT_LT(angles.film_rms, 0.3);
}

}  // namespace
}  // namespace spume::verification
