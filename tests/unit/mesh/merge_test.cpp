// Drawing tiny borders and films together, on the smallest foams that have them.
#include "spume/mesh/merge.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "spume/mesh/topology.hpp"
#include "tests/support/film_shapes.hpp"
#include "tests/support/short_edges.hpp"

namespace spume::mesh {
namespace {

constexpr double cell = 1e-5;  // [m], the wanted edge length
constexpr double tiny = 0.1;   // half the size of the features to be merged, in cells

double one_cell(const Vec3&) {
  return cell;
}

Vec3 at(double angle, double r, double z) {
  return cell * Vec3{r * std::cos(angle), r * std::sin(angle), z};
}

/// Phases 3, 4, … n + 2 around the z axis, `above` over and `below` under them; the films end at two rings of
/// n vertices two cells away. In the middle either the border on the axis between two junctions (n = 3,
/// vertices 0 and 1) or a film `above`|`below` with n corners (vertices 0 … n − 1).
struct Surroundings {
  int n;
  Phase above, below;
  FilmMesh mesh;

  Phase sector(int k) const { return 3 + (k + n) % n; }
  int upper(int k) const { return mesh.n_vertices() - 2 * n + (k + n) % n; }
  int lower(int k) const { return upper(k) + n; }
  void add_rings() {
    for (double z : {1.4, -1.4})
      for (int k = 0; k < n; ++k) mesh.position.push_back(at(2 * std::numbers::pi * k / n, 1.4, z));
  }
  void add(int a, int b, int c, Phase p, Phase q) { mesh.triangle.push_back(make_triangle(a, b, c, p, q)); }
};

FilmMesh short_border(Phase above, Phase below, double half_length) {
  Surroundings s{3, above, below, {}};
  s.mesh.position = {cell * Vec3{0, 0, half_length}, cell * Vec3{0, 0, -half_length}};
  s.add_rings();
  for (int k = 0; k < 3; ++k) {
    // Film k lies between the sectors k − 1 and k; its normal turns with the angle.
    s.add(1, s.upper(k), 0, s.sector(k - 1), s.sector(k));
    s.add(1, s.lower(k), s.upper(k), s.sector(k - 1), s.sector(k));
    s.add(0, s.upper(k), s.upper(k + 1), s.sector(k), above);
    s.add(1, s.lower(k), s.lower(k + 1), below, s.sector(k));
  }
  return s.mesh;
}

FilmMesh small_film(int n, double radius) {
  Surroundings s{n, 1, 2, {}};
  for (int k = 0; k < n; ++k) s.mesh.position.push_back(at(2 * std::numbers::pi * k / n, radius, 0));
  s.add_rings();
  for (int k = 0; k < n; ++k) {
    const int next = (k + 1) % n;
    s.add(k, s.lower(k), s.upper(k), s.sector(k - 1), s.sector(k));
    s.add(k, s.upper(k), s.upper(k + 1), s.sector(k), 1);
    s.add(k, s.upper(k + 1), next, s.sector(k), 1);
    s.add(k, s.lower(k), s.lower(k + 1), 2, s.sector(k));
    s.add(k, s.lower(k + 1), next, 2, s.sector(k));
    if (k > 0 && k + 1 < n) s.add(0, k, k + 1, 2, 1);
  }
  return s.mesh;
}

int merged(FilmMesh& mesh) {
  WorkingMesh work(mesh);
  RemeshParameters parameters;
  parameters.merge_below = 0.3;
  return merge_tiny_features(work, one_cell, parameters);
}

int edges_of_one_triangle(const FilmMesh& mesh) {
  int n = 0;
  for (const MeshEdge& e : build_edges(mesh).edge) n += e.n_uses == 1;
  return n;
}

/// All edges conform except those of one triangle, where the films of these small pieces of foam end.
void expect_conforming(const FilmMesh& mesh) {
  EXPECT_EQ(build_topology(mesh).n_nonconforming_edges, edges_of_one_triangle(mesh));
}

TEST(Merge, makes_one_junction_of_five_phases_from_a_short_border) {
  FilmMesh mesh = short_border(1, 2, tiny);
  expect_conforming(mesh);
  ASSERT_EQ(build_topology(mesh).n_junctions(), 2);
  const int n_ends = edges_of_one_triangle(mesh);
  EXPECT_EQ(merged(mesh), 1);
  expect_conforming(mesh);
  EXPECT_EQ(edges_of_one_triangle(mesh), n_ends);
  const Topology topology = build_topology(mesh);
  ASSERT_EQ(topology.n_junctions(), 1);
  EXPECT_TRUE(topology.vertex_phases[topology.junction[0]] == (PhaseSet{1, 2, 3, 4, 5}));
  EXPECT_EQ(topology.n_borders(), 6);
  EXPECT_LT(norm(mesh.position[topology.junction[0]]), 1e-12 * cell);  // the middle of the border
}

TEST(Merge, leaves_a_border_of_ordinary_length_alone) {
  FilmMesh mesh = short_border(1, 2, 0.2);
  EXPECT_EQ(merged(mesh), 0);
  EXPECT_EQ(build_topology(mesh).n_junctions(), 2);
}

TEST(Merge, is_refused_where_a_bubble_would_touch_itself) {
  FilmMesh mesh = short_border(1, 1, tiny);
  expect_conforming(mesh);
  EXPECT_EQ(merged(mesh), 0);
}

TEST(Merge, draws_a_small_film_of_three_or_four_borders_together) {
  for (int n : {3, 4}) {
    FilmMesh mesh = small_film(n, tiny);
    expect_conforming(mesh);
    const Topology before = build_topology(mesh);
    EXPECT_EQ(before.n_junctions(), n);
    EXPECT_EQ(merged(mesh), n - 1);
    expect_conforming(mesh);
    const Topology topology = build_topology(mesh);
    ASSERT_EQ(topology.n_junctions(), 1);
    EXPECT_EQ(topology.vertex_phases[topology.junction[0]].size(), n + 2);
    EXPECT_EQ(topology.n_lamellae(), before.n_lamellae() - 1);
    EXPECT_EQ(topology.n_borders(), before.n_borders() - n);
  }
}

// A tube of film three edges around, tiny in the middle: to draw the ring together would cut the bubble.
TEST(Merge, does_not_close_a_tunnel) {
  FilmMesh mesh;
  for (const auto& [r, z] : {std::pair{1.4, 1.4}, {tiny, 0.0}, {1.4, -1.4}})
    for (int k = 0; k < 3; ++k) mesh.position.push_back(at(2 * std::numbers::pi * k / 3, r, z));
  for (int ring : {0, 3})
    for (int k = 0; k < 3; ++k) {
      const int a = ring + k, b = ring + (k + 1) % 3;
      mesh.triangle.push_back(make_triangle(a, a + 3, b, 1, 0));
      mesh.triangle.push_back(make_triangle(b, a + 3, b + 3, 1, 0));
    }
  expect_conforming(mesh);
  EXPECT_EQ(merged(mesh), 0);
}

TEST(Merge, finds_nothing_in_a_foam_of_ordinary_size) {
  FilmMesh mesh = shapes::four_bubbles(8 * cell, 8);
  EXPECT_EQ(merged(mesh), 0);
}

TEST(Remesh, removes_tiny_borders_only_when_asked_to) {
  const auto where_it_is = [](const Vec3& x, const PhaseSet&) { return std::optional(x); };
  RemeshParameters parameters;
  parameters.collapse_below = 0.3;
  FilmMesh mesh = short_border(1, 2, tiny);
  remesh(mesh, one_cell, where_it_is, parameters);
  EXPECT_EQ(n_short_edges(mesh, one_cell), 1);
  parameters.merge_below = 0.3;
  EXPECT_EQ(remesh(mesh, one_cell, where_it_is, parameters).n_merged, 1);
  EXPECT_EQ(n_short_edges(mesh, one_cell), 0);
}

}  // namespace
}  // namespace spume::mesh
