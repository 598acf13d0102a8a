#include "spume/interface/smooth_area.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "spume/mesh/measure.hpp"
#include "spume/mesh/volume_constraint.hpp"
#include "tests/support/film_shapes.hpp"

namespace spume::interface {
namespace {

constexpr double radius = 8e-4;  // [m]

/// Relative errors of the area of a sphere of edges about radius/2^level: of the flat triangles that enclose
/// the right volume, and of the smooth film.
std::pair<double, double> errors_of_sphere(int level) {
  mesh::FilmMesh films = shapes::sphere({1e-5, 2e-5, 3e-5}, radius, level, 1);
  state::Phases phases;
  phases.target_volume = {0, 4 * std::numbers::pi / 3 * std::pow(radius, 3)};
  mesh::restore_volumes(films, phases.target_volume, 4, radius);
  const double exact = 4 * std::numbers::pi * radius * radius;
  return {mesh::film_area(films) / exact - 1,
          smooth_film_area(films, mesh::build_topology(films), phases) / exact - 1};
}

// Finer, the errors reach 1e-7 and change sign.
TEST(SmoothFilmArea, of_a_sphere_is_fourth_order) {
  const auto [flat, smooth] = errors_of_sphere(2);
  const auto [flat_fine, smooth_fine] = errors_of_sphere(3);
  EXPECT_NEAR(std::log2(flat / flat_fine), 2, 0.1);
  EXPECT_NEAR(std::log2(smooth / smooth_fine), 4.4, 0.5);
  EXPECT_LT(std::abs(smooth_fine), 0.01 * flat_fine);
}

// The exact cluster with vertices on the films: flat triangles enclose too little, which the targets mend.
TEST(SmoothFilmArea, of_four_bubbles_is_ten_times_better_than_that_of_flat_triangles) {
  mesh::FilmMesh films = shapes::four_bubbles(radius, 8);
  state::Phases phases;
  phases.target_volume = {0, 1, 1, 1, 1};
  for (int p = 1; p <= 4; ++p) phases.target_volume[p] = shapes::four_bubble_volume * std::pow(radius, 3);
  mesh::restore_volumes(films, phases.target_volume, 4, radius);
  const double exact = shapes::four_bubble_area * radius * radius;
  const double flat = mesh::film_area(films) / exact - 1;
  const double smooth = smooth_film_area(films, mesh::build_topology(films), phases) / exact - 1;
  EXPECT_GT(flat, 0);
  EXPECT_LT(std::abs(smooth), 0.1 * flat);
}

}  // namespace
}  // namespace spume::interface
