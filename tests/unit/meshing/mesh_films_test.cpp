#include "spume/meshing/mesh_films.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <optional>
#include <utility>

#include "spume/base/random.hpp"
#include "spume/mesh/measure.hpp"
#include "spume/meshing/figures.hpp"
#include "tests/support/film_shapes.hpp"

namespace spume::meshing {
namespace {

constexpr double radius = 3e-4;  // [m], the size of a bubble in a real foam

std::optional<Vec3> on_sphere(const Vec3& x, const mesh::PhaseSet&) {
  return radius * normalized(x);
}
std::optional<Vec3> on_pair(const Vec3& x, const mesh::PhaseSet& phases) {
  return shapes::on_double_bubble(radius, x, phases);
}
std::optional<Vec3> on_cluster(const Vec3& x, const mesh::PhaseSet& phases) {
  return shapes::on_four_bubbles(radius, x, phases);
}

/// Needles, caps and uneven edges: every vertex is moved about within its film.
mesh::FilmMesh shaken(mesh::FilmMesh films, double by, const mesh::Projection& project) {
  const mesh::Topology topology = mesh::build_topology(films);
  Random random(5);
  for (int v = 0; v < films.n_vertices(); ++v) {
    const Vec3 away{random.uniform(-by, by), random.uniform(-by, by), random.uniform(-by, by)};
    films.position[v] = *project(films.position[v] + away, topology.vertex_phases[v]);
  }
  return films;
}

MeshingParameters uniform() {
  MeshingParameters parameters;
  parameters.coarsest_at_borders = 1;
  return parameters;
}

/// The bar for a network's mesh, with exact projections, which leave vertices on their films to round-off.
void expect_good_mesh(const mesh::FilmMesh& films, const mesh::Topology& before,
                      const mesh::Projection& project) {
  const mesh::Topology topology = mesh::build_topology(films);
  EXPECT_EQ(topology.n_lamellae(), before.n_lamellae());
  EXPECT_EQ(topology.n_borders(), before.n_borders());
  EXPECT_EQ(topology.n_junctions(), before.n_junctions());
  const MeshFigures figures = figures_of(films, topology, project);
  EXPECT_EQ(figures.n_nonconforming_edges, 0);
  EXPECT_EQ(figures.n_turned, 0);
  EXPECT_GE(figures.smallest_angle_degrees, 20);
  EXPECT_GE(figures.median_angle_degrees, 45);
  EXPECT_GE(figures.share_round, 0.99);
  EXPECT_EQ(figures.n_unprojected, 0);
  EXPECT_EQ(figures.n_drawn_together, 0);
  EXPECT_LT(figures.film_distance, 1e-10 * radius);
  EXPECT_LT(figures.border_distance, 1e-10 * radius);
}

TEST(FilmMeshing, makes_a_rough_sphere_even) {
  mesh::FilmMesh films = shaken(shapes::sphere({}, radius, 3, 1), 0.06 * radius, on_sphere);
  const mesh::Topology before = mesh::build_topology(films);
  ASSERT_LT(mesh::measure_quality(films, before).smallest_angle_degrees, 12);
  const double h = 0.15 * radius;
  improve(films, on_sphere, h, uniform());
  expect_good_mesh(films, before, on_sphere);
  const mesh::Quality quality = mesh::measure_quality(films, mesh::build_topology(films));
  // Edges are split above 1.4 and collapsed below 0.7 of the target; moves change that a little.
  EXPECT_GT(quality.shortest_edge, 0.5 * h);
  EXPECT_LT(quality.longest_edge, 1.8 * h);
}

TEST(FilmMeshing, grades_towards_a_closed_border) {
  mesh::FilmMesh films = shaken(shapes::double_bubble(radius, 8), 0.04 * radius, on_pair);
  const mesh::Topology before = mesh::build_topology(films);
  const double h = 0.15 * radius;
  MeshingParameters parameters;
  parameters.edge_at_borders = 0.3 * h;
  improve(films, on_pair, h, parameters);
  expect_good_mesh(films, before, on_pair);
  const mesh::Topology topology = mesh::build_topology(films);
  // A ring of 2π √3/2 radius in parts of the target, give or take the band of lengths that are left alone.
  const double ring = mesh::border_lengths(films, topology).front();
  const double edge = ring / static_cast<double>(topology.border_edge.size());
  EXPECT_GT(edge, 0.7 * 0.3 * h);
  EXPECT_LT(edge, 1.4 * 0.3 * h);
  EXPECT_GT(mesh::measure_quality(films, topology).longest_edge, 0.8 * h);
}

TEST(FilmMeshing, fills_each_corner_of_a_film_with_one_triangle) {
  mesh::FilmMesh films = shaken(shapes::four_bubbles(radius, 6), 0.04 * radius, on_cluster);
  const mesh::Topology before = mesh::build_topology(films);
  improve(films, on_cluster, 0.15 * radius, {});
  expect_good_mesh(films, before, on_cluster);
  const mesh::Topology topology = mesh::build_topology(films);
  for (int junction : topology.junction) {
    std::map<int, int> triangles_of_lamella;
    for (int s = topology.star_offset[junction]; s < topology.star_offset[junction + 1]; ++s)
      ++triangles_of_lamella[topology.triangle_lamella[topology.star_triangle[s]]];
    EXPECT_EQ(triangles_of_lamella.size(), 6);
    for (const auto& [lamella, n] : triangles_of_lamella)
      EXPECT_EQ(n, 1) << "lamella " << lamella << " at " << junction;
  }
}

TEST(FilmMeshing, is_finer_where_borders_meet_if_asked) {
  mesh::FilmMesh films = shapes::four_bubbles(radius, 6);
  const mesh::Topology before = mesh::build_topology(films);
  const double h = 0.15 * radius;
  MeshingParameters parameters;
  parameters.edge_at_borders = 0.5 * h;
  parameters.edge_at_junctions = 0.1 * h;
  improve(films, on_cluster, h, parameters);
  expect_good_mesh(films, before, on_cluster);
  const mesh::Topology topology = mesh::build_topology(films);
  for (const auto& edge : topology.border_edge)
    for (int v : edge.vertex)
      if (topology.vertex_kind[v] == mesh::VertexKind::Junction) {
        EXPECT_LT(norm(films.edge(edge.vertex[0], edge.vertex[1])), 0.2 * h);
      }
}

/// Width of the strip over the target length in films.
class Strip : public ::testing::TestWithParam<double> {};

TEST_P(Strip, between_closed_borders_is_meshed_at_its_own_width) {
  const double h = 0.15 * radius, width = GetParam() * h;
  const auto on_ball = [&](const Vec3& x, const mesh::PhaseSet& phases) {
    return std::optional(shapes::on_sliced_ball(radius, width, x, phases));
  };
  mesh::FilmMesh films =
      shaken(shapes::sliced_ball(radius, width, 0.8 * h), 0.2 * std::min(h, width), on_ball);
  const mesh::Topology before = mesh::build_topology(films);
  ASSERT_EQ(before.n_lamellae(), 5);
  ASSERT_EQ(before.n_nonconforming_edges, 0);
  improve(films, on_ball, h, uniform());
  expect_good_mesh(films, before, on_ball);
}
INSTANTIATE_TEST_SUITE_P(Widths, Strip, ::testing::Values(0.25, 0.5, 1.0, 2.0, 3.0));

TEST(FilmMeshing, lets_a_mesh_follow_films_that_have_moved) {
  mesh::FilmMesh films = shapes::four_bubbles(radius, 6);
  const mesh::Topology before = mesh::build_topology(films);
  const double h = 0.15 * radius, larger = radius + 0.1 * h;
  improve(films, on_cluster, h, uniform());
  const auto on_larger_cluster = [&](const Vec3& x, const mesh::PhaseSet& phases) {
    return shapes::on_four_bubbles(larger, x, phases);
  };
  EXPECT_EQ(follow_films(films, on_larger_cluster), 0);
  expect_good_mesh(films, before, on_larger_cluster);
}

TEST(FilmMeshing, does_not_let_a_vertex_follow_that_would_fold_the_film) {
  mesh::FilmMesh films = shapes::sphere({}, radius, 3, 1);
  const auto corner = films.triangle[0].vertex;
  const Vec3 stays = films.position[corner[0]], beside = films.position[corner[1]];
  const auto astray = [&](const Vec3& x, const mesh::PhaseSet&) {
    return std::optional(norm(x - stays) == 0 ? radius * normalized(2 * beside - stays) : x);
  };
  EXPECT_EQ(follow_films(films, astray), 1);
  EXPECT_EQ(films.position[corner[0]], stays);
}

TEST(FilmMeshing, gives_the_same_mesh_again_to_the_last_bit) {
  const mesh::FilmMesh rough = shaken(shapes::four_bubbles(radius, 5), 0.04 * radius, on_cluster);
  mesh::FilmMesh a = rough, b = rough;
  improve(a, on_cluster, 0.2 * radius, {});
  improve(b, on_cluster, 0.2 * radius, {});
  EXPECT_EQ(a.position, b.position);
}

TEST(DrainageLayer, is_as_wide_as_the_root_of_thickness_times_border_radius) {
  // r = (5e-8/0.161254)^½ = 5.5684e-4 m.
  EXPECT_NEAR(drainage_layer_width(5e-6, 5e-8), std::sqrt(5e-6 * 5.5684e-4), 1e-9);
}

TEST(FilmMeshing, resolves_the_layer_within_its_limits) {
  const double h = 0.2 * radius;
  const auto border_edges = [&](double layer) {
    mesh::FilmMesh films = shapes::double_bubble(radius, 5);
    MeshingParameters parameters;
    parameters.layer_width = layer;
    improve(films, on_pair, h, parameters);
    return static_cast<double>(mesh::build_topology(films).border_edge.size());
  };
  const double ring = 2 * std::numbers::pi * std::sqrt(0.75) * radius;
  const MeshingParameters limits;
  // Lengths between 0.7 and 1.4 targets are left alone.
  for (const auto& [layer, target] :
       {std::pair(1e-3 * h, limits.finest_at_borders * h), std::pair(0.9 * h, 0.45 * h),
        std::pair(10 * h, limits.coarsest_at_borders * h)}) {
    EXPECT_GT(ring / border_edges(layer), 0.7 * target);
    EXPECT_LT(ring / border_edges(layer), 1.4 * target);
  }
}

TEST(MeshFigures, know_round_triangles_and_turned_ones) {
  EXPECT_NEAR(radius_ratio(2, 2, 2), 1, 1e-15);
  EXPECT_NEAR(radius_ratio(3, 4, 5), 2 * 1 / 2.5, 1e-15) << "inradius 1, circumradius 2.5";
  EXPECT_EQ(radius_ratio(1, 2, 3), 0);

  mesh::FilmMesh films = shapes::sphere({}, radius, 2, 1);
  EXPECT_EQ(figures_of(films, mesh::build_topology(films), on_sphere).n_turned, 0);
  // A vertex pulled beyond a neighbour folds the film.
  const auto corner = films.triangle[0].vertex;
  films.position[corner[0]] += 1.6 * films.edge(corner[0], corner[1]);
  const MeshFigures folded = figures_of(films, mesh::build_topology(films), on_sphere);
  EXPECT_GT(folded.n_turned, 0);
  EXPECT_GT(folded.film_distance, 0.01 * radius);
}

}  // namespace
}  // namespace spume::meshing
