#include "spume/mesh/parts.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <optional>
#include <vector>

#include "spume/mesh/measure.hpp"
#include "spume/mesh/quality.hpp"
#include "spume/mesh/remesh.hpp"
#include "spume/mesh/topology.hpp"
#include "spume/mesh/working_mesh.hpp"
#include "tests/support/film_shapes.hpp"

namespace spume::mesh {
namespace {

constexpr double radius = 0.002;  // [m]

parallel::Communicator alone() {
  return parallel::Communicator::self();
}

double longest_edge(const FilmMesh& mesh) {
  double longest = 0;
  for (const MeshEdge& e : build_edges(mesh).edge)
    longest = std::max(longest, norm(mesh.edge(e.low, e.high)));
  return longest;
}

/// Where the corners of every triangle are, in an order that numbers have no part in.
std::vector<std::array<double, 9>> corners_of(const FilmMesh& mesh) {
  std::vector<std::array<double, 9>> all;
  for (int t = 0; t < mesh.n_triangles(); ++t) {
    const auto [a, b, c] = mesh.corners(t);
    all.push_back({a.x, a.y, a.z, b.x, b.y, b.z, c.x, c.y, c.z});
  }
  std::ranges::sort(all);
  return all;
}

TEST(Parts, that_nothing_was_done_to_make_the_same_mesh_again) {
  const FilmMesh before = shapes::four_bubbles(radius, 8);
  FilmMesh mesh = before;
  const Slabs slabs(mesh, 4);
  int n_parts = 0;
  work_in_parts(
      mesh, slabs.of_triangles(mesh), 3, [&](FilmMesh&, int) { ++n_parts; }, alone());
  EXPECT_EQ(n_parts, 3);  // and the fourth is left alone
  EXPECT_EQ(mesh.n_vertices(), before.n_vertices());
  EXPECT_EQ(corners_of(mesh), corners_of(before));
  EXPECT_EQ(build_topology(mesh).n_nonconforming_edges, 0);
}

TEST(Parts, have_all_triangles_of_the_vertices_that_are_not_on_a_cut) {
  FilmMesh mesh = shapes::four_bubbles(radius, 8);
  const Slabs slabs(mesh, 3);
  std::map<std::array<double, 3>, int> n_triangles;  // at a point
  const auto place = [](const Vec3& x) { return std::array{x.x, x.y, x.z}; };
  for (const FilmTriangle& t : mesh.triangle)
    for (int v : t.vertex) ++n_triangles[place(mesh.position[v])];
  const auto work = [&](FilmMesh& part, int n_cut) {
    ASSERT_GT(n_cut, 0);
    ASSERT_LT(n_cut, part.n_vertices() / 2);
    const VertexStars star(part);
    for (int v = 0; v < part.n_vertices(); ++v) {
      const int n = static_cast<int>(star[v].size()), all = n_triangles.at(place(part.position[v]));
      EXPECT_GT(n, 0);
      if (v < n_cut)
        EXPECT_LT(n, all);
      else
        EXPECT_EQ(n, all);
    }
  };
  work_in_parts(mesh, slabs.of_triangles(mesh), 3, work, alone());
}

TEST(Parts, may_change_all_but_their_cut) {
  FilmMesh mesh = shapes::four_bubbles(radius, 8);
  const int n_vertices = mesh.n_vertices();
  const Slabs slabs(mesh, 2);
  const Vec3 shift{0, 0.1 * radius, 0};
  const auto work = [&](FilmMesh& part, int n_cut) {
    for (int v = n_cut; v < part.n_vertices(); ++v) part.position[v] += shift;
    // A vertex more, in the middle of a triangle.
    const FilmTriangle whole = part.triangle[0];
    const auto [a, b, c] = whole.vertex;
    part.position.push_back((part.position[a] + part.position[b] + part.position[c]) / 3.0);
    const int middle = part.n_vertices() - 1;
    part.triangle[0].vertex = {a, b, middle};
    part.triangle.push_back({{b, c, middle}, whole.phase_a, whole.phase_b});
    part.triangle.push_back({{c, a, middle}, whole.phase_a, whole.phase_b});
  };
  const int n_cut = work_in_parts(mesh, slabs.of_triangles(mesh), 2, work, alone());
  EXPECT_EQ(mesh.n_vertices(), n_vertices + 2);
  EXPECT_EQ(build_topology(mesh).n_nonconforming_edges, 0);
  int n_unmoved = 0;
  for (const Vec3& x : shapes::four_bubbles(radius, 8).position)
    n_unmoved += std::ranges::any_of(mesh.position, [&](const Vec3& y) { return norm(x - y) == 0; });
  EXPECT_EQ(n_unmoved, n_cut);
}

TEST(Slabs, hold_the_same_number_of_vertices) {
  const FilmMesh mesh = shapes::sphere({0, 0, 0}, radius, 4, 1);
  const Slabs slabs(mesh, 4);
  std::vector<int> n(4, 0);
  for (const Vec3& x : mesh.position) ++n[slabs.of(x)];
  for (int slab = 0; slab < 4; ++slab) EXPECT_NEAR(n[slab], mesh.n_vertices() / 4, 64);  // rings of equal z
}

TEST(Seams, reach_a_number_of_edges_beyond_the_cuts) {
  FilmMesh mesh = shapes::sphere({0, 0, 0}, radius, 4, 1);
  const double edge = longest_edge(mesh);
  const Slabs slabs(mesh, 3);
  const int n_cut = work_in_parts(
      mesh, slabs.of_triangles(mesh), 3, [](FilmMesh&, int) {}, alone());
  const auto one = seams_of_triangles(mesh, slabs, n_cut, 1),
             three = seams_of_triangles(mesh, slabs, n_cut, 3);
  std::vector<int> n(3, 0);
  for (int t = 0; t < mesh.n_triangles(); ++t) {
    ++n[three[t]];
    const auto& v = mesh.triangle[t].vertex;
    const bool touches = std::ranges::any_of(v, [&](int w) { return w < n_cut; });
    EXPECT_EQ(one[t] < 2, touches);
    if (touches) {
      EXPECT_EQ(three[t], one[t]);
    }
    if (three[t] == 2) continue;
    const auto distance = [&](int w) {
      double least = radius;
      for (int c = 0; c < n_cut; ++c)
        if (slabs.of(mesh.position[c]) - 1 == three[t]) least = std::min(least, norm(mesh.edge(w, c)));
      return least;
    };
    for (int w : v) EXPECT_LE(distance(w), 3 * edge);
  }
  // Rings of five or six rows of triangles around circles of latitude of about 30 edges.
  EXPECT_GT(n[0], 150);
  EXPECT_GT(n[1], 150);
  EXPECT_GT(n[2], mesh.n_triangles() / 2);
}

// What only a mesh in slabs could get wrong: films, borders and junctions that the cuts go through.
TEST(Remesh, in_slabs_is_as_good_as_in_one) {
  constexpr int n = 32;
  const FilmMesh fine = shapes::four_bubbles(radius, n);
  const double edge = 2 * shapes::four_bubble_border * radius / n;
  const auto target = [edge](const Vec3&) { return edge; };
  const auto project = [](const Vec3& x, const PhaseSet& phases) {
    return std::optional(shapes::on_four_bubbles(radius, x, phases));
  };
  RemeshParameters parameters;
  FilmMesh in_one = fine, in_slabs = fine;
  const RemeshReport report = remesh(in_one, target, project, parameters);
  parameters.least_slab = fine.n_vertices() / 4;
  const RemeshReport report_in_slabs = remesh(in_slabs, target, project, parameters);
  EXPECT_EQ(report_in_slabs.n_left_short, report.n_left_short);
  const Topology topology = build_topology(in_slabs), topology_in_one = build_topology(in_one);
  EXPECT_EQ(topology.n_nonconforming_edges, 0);
  EXPECT_EQ(topology.n_lamellae(), 10);
  EXPECT_EQ(topology.n_borders(), 10);
  EXPECT_EQ(topology.n_junctions(), 5);
  const Quality quality = measure_quality(in_slabs, topology),
                quality_in_one = measure_quality(in_one, topology_in_one);
  EXPECT_NEAR(in_slabs.n_vertices(), in_one.n_vertices(), 0.01 * in_one.n_vertices());
  EXPECT_NEAR(film_area(in_slabs), film_area(in_one), 1e-5 * film_area(in_one));
  EXPECT_GT(quality.smallest_angle_degrees, quality_in_one.smallest_angle_degrees - 3);
  EXPECT_NEAR(quality.median_angle_degrees, quality_in_one.median_angle_degrees, 1);
  EXPECT_NEAR(quality.longest_edge, quality_in_one.longest_edge, 0.1 * edge);
}

TEST(Remesh, in_slabs_between_which_there_are_no_films_is_that_of_each_piece) {
  const FilmMesh one = shapes::sphere({0, 0, 0}, radius, 4, 1);
  FilmMesh both = one;
  const FilmMesh other = shapes::sphere({0, 0, 3 * radius}, radius, 4, 2);
  both.position.insert(both.position.end(), other.position.begin(), other.position.end());
  for (FilmTriangle t : other.triangle) {
    for (int& v : t.vertex) v += one.n_vertices();
    both.triangle.push_back(t);
  }
  const double edge = 2 * longest_edge(one);
  const auto target = [edge](const Vec3&) { return edge; };
  const auto where_it_is = [](const Vec3& x, const PhaseSet&) { return std::optional(x); };
  RemeshParameters parameters;
  parameters.least_slab = one.n_vertices();
  FilmMesh alone_one = one, alone_other = other;
  remesh(alone_one, target, where_it_is, {});
  remesh(alone_other, target, where_it_is, {});
  remesh(both, target, where_it_is, parameters);
  auto expected = corners_of(alone_one);
  const auto more = corners_of(alone_other);
  expected.insert(expected.end(), more.begin(), more.end());
  std::ranges::sort(expected);
  EXPECT_EQ(corners_of(both), expected);
}

TEST(Remesh, of_a_film_at_one_height_is_that_of_one_slab) {
  // All vertices at one height: no bound between slabs has anything below it.
  FilmMesh mesh;
  constexpr int n = 12;
  for (int j = 0; j <= n; ++j)
    for (int i = 0; i <= n; ++i) mesh.position.push_back({1e-3 * i, 1e-3 * j, 0});
  for (int j = 0; j < n; ++j)
    for (int i = 0; i < n; ++i) {
      const int v = j * (n + 1) + i;
      mesh.triangle.push_back({{v, v + 1, v + n + 2}, 0, 1});
      mesh.triangle.push_back({{v, v + n + 2, v + n + 1}, 0, 1});
    }
  const auto target = [](const Vec3&) { return 3e-3; };
  const auto where_it_is = [](const Vec3& x, const PhaseSet&) { return std::optional(x); };
  FilmMesh in_slabs = mesh;
  RemeshParameters parameters;
  remesh(mesh, target, where_it_is, parameters);
  parameters.least_slab = 20;
  remesh(in_slabs, target, where_it_is, parameters);
  EXPECT_EQ(corners_of(in_slabs), corners_of(mesh));
}

}  // namespace
}  // namespace spume::mesh
