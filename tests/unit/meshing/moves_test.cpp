#include "spume/meshing/moves.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <vector>

#include "spume/base/random.hpp"
#include "spume/meshing/figures.hpp"
#include "spume/meshing/forces.hpp"
#include "tests/support/film_shapes.hpp"

namespace spume::meshing {
namespace {

constexpr double radius = 3e-4;  // [m]

std::optional<Vec3> on_cluster(const Vec3& x, const mesh::PhaseSet& phases) {
  return shapes::on_four_bubbles(radius, x, phases);
}
std::optional<Vec3> where_it_is(const Vec3& x, const mesh::PhaseSet&) {
  return x;
}

/// A flat hexagon of six equilateral triangles of unit edge around vertex 0, one film; its rim is held.
mesh::FilmMesh hexagon() {
  mesh::FilmMesh films;
  films.position.push_back({});
  for (int n = 0; n < 6; ++n)
    films.position.push_back({std::cos(std::numbers::pi * n / 3), std::sin(std::numbers::pi * n / 3), 0});
  for (int n = 0; n < 6; ++n) films.triangle.push_back({{0, 1 + n, 1 + (n + 1) % 6}, 0, 1});
  return films;
}

TEST(Forces, leave_an_even_film_alone_and_bring_a_vertex_back_to_the_middle) {
  mesh::FilmMesh films = hexagon();
  mesh::WorkingMesh work(films);
  const StarMesh star_mesh(work);
  const std::vector<double> even(7, 1.0);
  EXPECT_LT(norm(wanted_displacement(star_mesh, even, 0)), 1e-14);
  EXPECT_EQ(norm(wanted_displacement(star_mesh, even, 1)), 0) << "held at the rim";
  films.position[0] = {0.2, 0.1, 0};
  EXPECT_LT(dot(wanted_displacement(star_mesh, even, 0), films.position[0]), 0);
}

TEST(Forces, make_edges_longer_where_targets_are_longer) {
  mesh::FilmMesh films = hexagon();
  mesh::WorkingMesh work(films);
  const StarMesh star_mesh(work);
  const std::vector<double> target{1, 1.3, 1, 1, 1, 1, 1};  // longer at (1, 0, 0)
  EXPECT_LT(wanted_displacement(star_mesh, target, 0).x, -0.01);
}

TEST(Forces, space_border_vertices_evenly_by_their_targets) {
  mesh::FilmMesh films = shapes::double_bubble(radius, 6);
  const mesh::Topology topology = mesh::build_topology(films);
  const auto& ring = topology.border.front().vertices;
  mesh::WorkingMesh work(films);
  const StarMesh star_mesh(work);
  std::vector<double> target(films.n_vertices(), 0.1 * radius);
  EXPECT_LT(norm(wanted_displacement(star_mesh, target, ring[1])), 1e-12 * radius) << "even already";

  // Targets of 0.1, 0.1, 0.3 along the ring: the edges beside ring[1] want to be as 1 : 2, two equal ones of
  // length d go there by a shift of d/3, half of which is made.
  target[ring[2]] = 0.3 * radius;
  const Vec3 on = films.edge(ring[1], ring[2]);
  const Vec3 shift = wanted_displacement(star_mesh, target, ring[1]);
  EXPECT_NEAR(norm(shift) / norm(on), 1.0 / 6, 1e-9);
  EXPECT_LT(dot(shift, on), 0);
}

TEST(Moves, never_turn_a_triangle_or_lower_a_small_angle) {
  mesh::FilmMesh films = shapes::four_bubbles(radius, 6);
  const double edge = radius / 6;
  Random random(8);
  mesh::WorkingMesh work(films);
  StarMesh star_mesh(work);
  const auto smallest_angle = [&] {
    const auto figures = figures_of(films, mesh::build_topology(films), on_cluster);
    EXPECT_EQ(figures.n_turned, 0);
    return figures.smallest_angle_degrees;
  };
  double angle = smallest_angle();
  for (int sweep = 0; sweep < 10; ++sweep) {
    std::vector<double> wild(films.n_vertices());  // targets that ask for a very uneven mesh
    for (double& length : wild) length = edge * std::pow(10, random.uniform(-1, 1));
    EXPECT_GT(move_vertices(star_mesh, on_cluster, wild), 0);
    const double now = smallest_angle();
    EXPECT_GE(now, std::min(angle, 30.0) - 1e-9);
    angle = now;
  }
}

TEST(Moves, halve_the_step_until_the_triangles_around_allow_it) {
  mesh::FilmMesh films = hexagon();
  films.position[1] = {0.15, 0, 0};  // a notch in the rim, which the forces would push the middle across
  films.position[0] = {0.1, 0, 0};
  mesh::WorkingMesh work(films);
  StarMesh star_mesh(work);
  const std::vector<double> target(7, 0.3);
  for (int sweep = 0; sweep < 5; ++sweep) move_vertices(star_mesh, where_it_is, target);
  for (int t = 0; t < films.n_triangles(); ++t) EXPECT_GT(mesh::doubled_area_normal(films, t).z, 0);
  EXPECT_LT(films.position[0].x, 0.1);
}

TEST(Moves, put_vertices_onto_their_films_but_for_those_that_would_spoil_triangles) {
  mesh::FilmMesh films = hexagon();
  mesh::WorkingMesh work(films);
  StarMesh star_mesh(work);
  const auto raised = [](const Vec3& x, const mesh::PhaseSet&) { return std::optional(x + Vec3{0, 0, 0.1}); };
  EXPECT_EQ(project_vertices(star_mesh, raised, 20), 0);
  EXPECT_EQ(films.position[0].z, 0.1);
  const auto beyond_the_rim = [](const Vec3&, const mesh::PhaseSet&) { return std::optional(Vec3{2, 0, 0}); };
  EXPECT_EQ(project_vertices(star_mesh, beyond_the_rim, 20), 1);
  EXPECT_EQ(films.position[0].x, 0);
}

}  // namespace
}  // namespace spume::meshing
