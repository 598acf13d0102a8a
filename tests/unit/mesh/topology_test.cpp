#include "spume/mesh/topology.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace spume::mesh {
namespace {

/// Two pyramids of `n` sides glued at their base: the coarsest double bubble. Vertices: ring 0 … n−1, apex of
/// bubble 1, apex of bubble 2, centre of the septum.
FilmMesh double_pyramid(int n) {
  FilmMesh mesh;
  for (int i = 0; i < n; ++i) {
    const double angle = 2 * std::numbers::pi * i / n;
    mesh.position.push_back({0, std::cos(angle), std::sin(angle)});
  }
  const int apex_1 = n, apex_2 = n + 1, centre = n + 2;
  mesh.position.insert(mesh.position.end(), {{-1, 0, 0}, {1, 0, 0}, {0, 0, 0}});
  for (int i = 0; i < n; ++i) {
    const int j = (i + 1) % n;
    mesh.triangle.push_back(make_triangle(i, apex_1, j, 1, 0));
    mesh.triangle.push_back(make_triangle(i, j, apex_2, 2, 0));
    mesh.triangle.push_back(make_triangle(i, j, centre, 1, 2));
  }
  return mesh;
}

/// A regular tetrahedron cut into four bubbles by its centre: four caps, six inner films, ten borders, five
/// junctions.
FilmMesh four_cells() {
  FilmMesh mesh;
  mesh.position = {{1, 1, 1}, {1, -1, -1}, {-1, 1, -1}, {-1, -1, 1}, {0, 0, 0}};
  const int face[4][3] = {{1, 2, 3}, {0, 3, 2}, {0, 1, 3}, {0, 2, 1}};  // cell p+1 is opposite corner p
  for (int p = 0; p < 4; ++p) {
    const Vec3 a = mesh.position[face[p][0]], b = mesh.position[face[p][1]], c = mesh.position[face[p][2]];
    const bool outward = dot(cross(b - a, c - a), a + b + c) > 0;
    mesh.triangle.push_back(outward ? make_triangle(face[p][0], face[p][1], face[p][2], p + 1, 0)
                                    : make_triangle(face[p][0], face[p][1], face[p][2], 0, p + 1));
  }
  for (int p = 0; p < 4; ++p)
    for (int q = p + 1; q < 4;
         ++q) {  // the film between cells p and q contains the edge of the two other corners
      int ends[2], n = 0;
      for (int c = 0; c < 4; ++c)
        if (c != p && c != q) ends[n++] = c;
      const Vec3 normal = cross(mesh.position[ends[0]], mesh.position[ends[1]]);
      // cell q+1 lies on the side of corner p
      mesh.triangle.push_back(dot(normal, mesh.position[p] - mesh.position[q]) > 0
                                  ? make_triangle(4, ends[0], ends[1], p + 1, q + 1)
                                  : make_triangle(4, ends[0], ends[1], q + 1, p + 1));
    }
  return mesh;
}

TEST(Topology, a_double_bubble_has_three_lamellae_and_one_closed_border) {
  const Topology topology = build_topology(double_pyramid(7));
  EXPECT_EQ(topology.n_nonconforming_edges, 0);
  EXPECT_EQ(topology.n_lamellae(), 3);
  ASSERT_EQ(topology.n_borders(), 1);
  EXPECT_EQ(topology.n_junctions(), 0);
  EXPECT_TRUE(topology.border[0].closed);
  EXPECT_EQ(topology.border[0].phases, (std::array<Phase, 3>{0, 1, 2}));
  EXPECT_EQ(topology.border[0].vertices.size(), 8u);
  EXPECT_EQ(topology.border[0].vertices.front(), topology.border[0].vertices.back());
  EXPECT_EQ(topology.film_dof.size(), 3u * 7 + 3);
  EXPECT_EQ(topology.border_dof.size(), 7u);
}

TEST(Topology, four_cells_have_ten_lamellae_ten_borders_and_five_junctions) {
  const Topology topology = build_topology(four_cells());
  EXPECT_EQ(topology.n_nonconforming_edges, 0);
  EXPECT_EQ(topology.n_lamellae(), 10);
  EXPECT_EQ(topology.n_borders(), 10);
  EXPECT_EQ(topology.n_junctions(), 5);
  EXPECT_EQ(topology.border_dof.size(), 20u);
  for (const auto& border : topology.border) {
    EXPECT_FALSE(border.closed);
    EXPECT_EQ(border.vertices.size(), 2u);
  }
}

TEST(Topology, counts_edges_that_belong_to_no_film_or_border) {
  FilmMesh mesh = double_pyramid(7);
  mesh.triangle.pop_back();  // a hole in the septum: its three edges
  EXPECT_EQ(build_topology(mesh).n_nonconforming_edges, 3);
  mesh = double_pyramid(7);
  std::swap(mesh.triangle[0].vertex[0], mesh.triangle[0].vertex[1]);  // turned over
  EXPECT_EQ(build_topology(mesh).n_nonconforming_edges, 2);
}

TEST(Topology, two_films_of_one_pair_that_do_not_touch_are_two_lamellae) {
  FilmMesh mesh = double_pyramid(5);
  const FilmMesh copy = mesh;
  for (const auto& x : copy.position) mesh.position.push_back(x + Vec3{10, 0, 0});
  for (auto t : copy.triangle) {
    for (int& v : t.vertex) v += copy.n_vertices();
    mesh.triangle.push_back(t);
  }
  const Topology topology = build_topology(mesh);
  EXPECT_EQ(topology.n_lamellae(), 6);
  EXPECT_EQ(topology.n_borders(), 2);
}

}  // namespace
}  // namespace spume::mesh
