#include "spume/transport/even_stretch.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "tests/support/film_shapes.hpp"
#include "tests/unit/transport/film_patterns.hpp"

namespace spume {
namespace {

using patterns::Foam;

constexpr double radius = 1e-3;   // [m]
constexpr double eta0 = 1e-6;     // [m]
constexpr double lambda0 = 1e-9;  // [m²]
// The last digits of the sum of some hundred dofs go to one of them.
constexpr double round_off = 1e-12;

/// The double bubble drawn out where z > 0, by a factor that grows from 1 to 2: mesh and films stretch
/// unevenly.
mesh::FilmMesh drawn_out(mesh::FilmMesh films) {
  for (Vec3& x : films.position)
    if (x.z > 0) x.z += x.z * x.z / radius;
  return films;
}

double slanted(const Vec3& x) {
  return eta0 * (1.5 + x.y / radius);
}

double slanted_border(const Vec3& x) {
  return lambda0 * slanted(x) / eta0;
}

TEST(EvenStretch, KeepsUniformFilmsAndBordersUniform) {
  const Foam before(shapes::double_bubble(radius, 6));
  const mesh::FilmMesh after = drawn_out(before.films);
  state::FilmLiquid liquid = transport::uniform_liquid(before.films, before.topology, eta0, lambda0);
  transport::stretch_evenly(before.films, after, before.topology, liquid);
  const auto old_area = mesh::lamella_areas(before.films, before.topology),
             area = mesh::lamella_areas(after, before.topology),
             dof_area = mesh::film_dof_areas(after, before.topology);
  for (std::size_t d = 0; d < dof_area.size(); ++d) {
    const int l = before.topology.film_dof[d].lamella;
    EXPECT_NEAR(liquid.lamella_volume[d] / (2 * dof_area[d] * eta0), old_area[l] / area[l], round_off);
  }
  const double old_length = mesh::border_lengths(before.films, before.topology)[0],
               length = mesh::border_lengths(after, before.topology)[0];
  EXPECT_GT(length, 1.1 * old_length);
  const auto dof_length = mesh::border_dof_lengths(after, before.topology);
  for (std::size_t d = 0; d < dof_length.size(); ++d)
    EXPECT_NEAR(liquid.border_volume[d] / (dof_length[d] * lambda0), old_length / length, round_off);
}

TEST(EvenStretch, KeepsTheLiquidOfEachLamellaAndTheShapeOfItsThickness) {
  const Foam before(shapes::double_bubble(radius, 6));
  Foam after = before;
  after.films = drawn_out(before.films);
  const state::FilmLiquid old_liquid = patterns::liquid_of(before, slanted, slanted_border);
  state::FilmLiquid liquid = old_liquid;
  transport::stretch_evenly(before.films, after.films, before.topology, liquid);
  const auto eta = patterns::half_thickness(after, liquid);
  for (int l = 0; l < before.topology.n_lamellae(); ++l) {
    const double held = patterns::held_by(before, old_liquid, l);
    EXPECT_NEAR(patterns::held_by(after, liquid, l) / held, 1, 1e-14);
    double factor = 0;
    for (std::size_t d = 0; d < eta.size(); ++d) {
      if (before.topology.film_dof[d].lamella != l) continue;
      const double ratio = eta[d] / slanted(before.films.position[before.topology.film_dof[d].vertex]);
      if (factor == 0) factor = ratio;
      EXPECT_NEAR(ratio, factor, round_off);
    }
    EXPECT_LT(factor, 1);
  }
}

TEST(EvenStretch, KeepsTheLedgerThroughAThousandSteps) {
  const Foam foam(shapes::double_bubble(radius, 6));
  state::FilmLiquid liquid = patterns::liquid_of(foam, slanted, slanted_border);
  const double held = liquid.total();
  mesh::FilmMesh films = foam.films;
  for (int n = 0; n < 1000; ++n) {
    const mesh::FilmMesh before = films;
    for (Vec3& x : films.position) x.z *= n % 3 == 0 ? 1.01 : 0.995;
    transport::stretch_evenly(before, films, foam.topology, liquid);
  }
  EXPECT_NEAR(liquid.total() / held, 1, 1e-15);
}

TEST(EvenStretch, GivesADofThatHadNoAreaTheMeanOfItsLamella) {
  Foam before(shapes::sphere({}, radius, 2, 1));
  Foam after = before;
  const int v = before.films.triangle[0].vertex[0];
  for (const auto& triangle : before.films.triangle)
    for (int corner : triangle.vertex)
      if (std::find(triangle.vertex.begin(), triangle.vertex.end(), v) != triangle.vertex.end())
        before.films.position[corner] = before.films.position[v];
  state::FilmLiquid liquid = patterns::liquid_of(
      before, [](const Vec3&) { return eta0; }, slanted_border);
  const double held = liquid.total();
  transport::stretch_evenly(before.films, after.films, before.topology, liquid);
  EXPECT_NEAR(liquid.total() / held, 1, 1e-14);
  const double mean = held / (2 * mesh::film_area(after.films));
  for (double eta : patterns::half_thickness(after, liquid)) EXPECT_NEAR(eta / mean, 1, round_off);
}

TEST(EvenStretch, KeepsTheLiquidOfALamellaThatShrinksToAPointAndComesBack) {
  const Foam sphere(shapes::sphere({}, radius, 2, 1));
  Foam point = sphere;
  for (Vec3& x : point.films.position) x = {};
  const state::FilmLiquid start = patterns::liquid_of(sphere, slanted, slanted_border);
  state::FilmLiquid liquid = start;
  transport::stretch_evenly(sphere.films, point.films, sphere.topology, liquid);
  EXPECT_EQ(liquid.lamella_volume, start.lamella_volume);
  transport::stretch_evenly(point.films, sphere.films, sphere.topology, liquid);
  EXPECT_NEAR(liquid.total() / start.total(), 1, 1e-14);
  const double mean = start.total() / (2 * mesh::film_area(sphere.films));
  for (double eta : patterns::half_thickness(sphere, liquid)) EXPECT_NEAR(eta / mean, 1, round_off);
}

}  // namespace
}  // namespace spume
