#include "spume/mesh/quality.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>
#include <utility>

#include "tests/support/film_shapes.hpp"

namespace spume::mesh {
namespace {

constexpr double radius = 3e-4;  // [m]

TEST(Quality, an_icosahedron_is_made_of_equilateral_triangles) {
  const FilmMesh mesh = shapes::sphere({}, radius, 0, 1);
  const Quality quality = measure_quality(mesh, build_topology(mesh));
  const double edge = 4 * radius / std::sqrt(10 + 2 * std::sqrt(5.0));
  EXPECT_NEAR(quality.smallest_angle_degrees, 60, 1e-10);
  EXPECT_NEAR(quality.median_angle_degrees, 60, 1e-10);
  EXPECT_NEAR(quality.shortest_edge, edge, 1e-12 * radius);
  EXPECT_NEAR(quality.longest_edge, edge, 1e-12 * radius);
  EXPECT_EQ(quality.n_inverted, 0);
}

TEST(Quality, the_worst_triangle_and_the_edges_are_found) {
  FilmMesh mesh = shapes::double_bubble(radius, 8);
  const auto corner = mesh.triangle[40].vertex;
  const double edge = norm(mesh.position[corner[1]] - mesh.position[corner[0]]);
  shapes::split_edge(mesh, corner[0], corner[1], 0.01);
  const Quality quality = measure_quality(mesh, build_topology(mesh));
  EXPECT_NEAR(quality.shortest_edge, 0.01 * edge, 1e-10 * radius);
  EXPECT_LT(quality.smallest_angle_degrees, 1);
  EXPECT_GT(quality.median_angle_degrees, 30);
}

TEST(Quality, a_triangle_folded_over_counts_as_inverted) {
  FilmMesh mesh = shapes::sphere({}, radius, 3, 1);
  // One vertex dragged along the film, beyond the far side of one of its triangles.
  const auto corner = mesh.triangle[100].vertex;
  const Vec3 middle = 0.5 * (mesh.position[corner[1]] + mesh.position[corner[2]]);
  mesh.position[corner[0]] =
      radius * normalized(mesh.position[corner[0]] + 1.4 * (middle - mesh.position[corner[0]]));
  EXPECT_GE(measure_quality(mesh, build_topology(mesh)).n_inverted, 1);
}

TEST(Quality, borders_are_not_taken_for_folds) {
  const FilmMesh mesh = shapes::four_bubbles(radius, 6);
  EXPECT_EQ(measure_quality(mesh, build_topology(mesh)).n_inverted, 0);
}

TEST(Quality, an_empty_mesh_has_none) {
  EXPECT_THROW(measure_quality(FilmMesh{}, Topology{}), std::logic_error);
}

}  // namespace
}  // namespace spume::mesh
