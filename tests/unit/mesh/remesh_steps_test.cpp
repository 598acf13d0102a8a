// Each rule of the remesher by itself, on the smallest meshes that need it.
#include <gtest/gtest.h>

#include <algorithm>
#include <numbers>
#include <stdexcept>
#include <utility>
#include <vector>

#include "spume/base/random.hpp"
#include "spume/mesh/collapse.hpp"
#include "spume/mesh/flip.hpp"
#include "spume/mesh/smooth.hpp"
#include "spume/mesh/split.hpp"
#include "tests/support/film_shapes.hpp"

namespace spume::mesh {
namespace {

constexpr double length = 1e-5;  // [m], a typical edge

std::optional<Vec3> where_it_is(const Vec3& x, const PhaseSet&) {
  return x;
}
double one_length(const Vec3&) {
  return length;
}

/// A flat film: vertex 0 at the origin amid a ring that cannot move. Corners in units of `length`.
FilmMesh fan(const std::vector<Vec3>& ring) {
  FilmMesh mesh;
  mesh.position.push_back({});
  for (const Vec3& x : ring) mesh.position.push_back(length * x);
  const int n = static_cast<int>(ring.size());
  for (int v = 0; v < n; ++v) mesh.triangle.push_back(make_triangle(0, 1 + v, 1 + (v + 1) % n, 1, 2));
  return mesh;
}

/// Collapses in a fan whose only short edge goes from the middle to the first vertex of the ring, half a
/// length away.
int collapses_in_fan(const std::vector<Vec3>& dent) {
  std::vector<Vec3> ring{{0.5, 0, 0}, {2.2, 1, 0}};
  ring.insert(ring.end(), dent.begin(), dent.end());
  ring.insert(ring.end(), {{-2.5, 0.7, 0}, {-0.7, -2.5, 0}, {1.8, -2, 0}});
  FilmMesh mesh = fan(ring);
  WorkingMesh work(mesh);
  RemeshParameters parameters;
  parameters.no_edge_beyond = 10;
  return collapse_short_edges(work, one_length, parameters);
}

TEST(Collapse, is_done_in_a_convex_fan) {
  EXPECT_EQ(collapses_in_fan({{0.4, 1.1, 0}, {-1, 2, 0}}), 1);
}

TEST(Collapse, is_refused_when_a_triangle_would_turn_over) {
  // The line through these two passes at x = 0.25 between the middle and the first vertex.
  EXPECT_EQ(collapses_in_fan({{0.4, 1.1, 0}, {0.67, 3.1, 0}}), 0);
}

TEST(Collapse, is_refused_when_it_makes_a_sliver_of_a_decent_triangle) {
  // The line through these two passes just beyond the first vertex, at x = 0.55.
  EXPECT_EQ(collapses_in_fan({{0.4, 1.1, 0}, {0.13, 3.1, 0}}), 0);
}

TEST(Collapse, is_refused_when_an_edge_would_be_too_long) {
  FilmMesh mesh =
      fan({{0.5, 0, 0}, {0.25, 0.8, 0}, {-0.6, 0.9, 0}, {-1.4, 0, 0}, {-0.6, -0.9, 0}, {0.25, -0.8, 0}});
  WorkingMesh work(mesh);
  EXPECT_EQ(collapse_short_edges(work, one_length, {}), 0);  // 1.9 > 1.8
  RemeshParameters parameters;
  parameters.no_edge_beyond = 2;
  EXPECT_EQ(collapse_short_edges(work, one_length, parameters), 1);
}

TEST(Collapse, may_exceed_the_limit_for_a_tiny_edge) {
  FilmMesh mesh =
      fan({{0.2, 0, 0}, {0.25, 0.8, 0}, {-0.6, 0.9, 0}, {-1.7, 0, 0}, {-0.6, -0.9, 0}, {0.25, -0.8, 0}});
  WorkingMesh work(mesh);
  EXPECT_EQ(collapse_short_edges(work, one_length, {}), 1);  // 1.9 < 2.2
}

/// Collapses in a flat fan whose tiny edge goes from the middle to `near`, and which has one steep sliver:
/// between (1, 1, 0) and `sliver` beside it. In units of `length`.
int collapses_beside_sliver(const Vec3& near, const Vec3& sliver) {
  FilmMesh mesh = fan({{1, -1, 0}, {1, 1, 0}, Vec3{1, 1, 0} + sliver, {-1, 1, 0}, near, {-1, -1, 0}});
  WorkingMesh work(mesh);
  return collapse_short_edges(work, one_length, {});
}

TEST(Collapse, a_triangle_that_faces_away_does_not_stop_it_unless_it_gets_worse) {
  // Its cosine with the film is 0.24 for the tiny edge's limit of 0.3; seen from farther left it rises to
  // 0.25.
  EXPECT_EQ(collapses_beside_sliver({-0.16, 0.08, 0}, {0, 0.02, 0.16}), 1);
  EXPECT_EQ(collapses_beside_sliver({-0.08, -0.16, 0}, {0, 0.02, 0.16}), 0);
}

TEST(Collapse, a_sliver_of_no_area_does_not_stop_it) {
  EXPECT_EQ(collapses_beside_sliver({-0.08, -0.16, 0}, {0, 0.001, 0.006}), 1);
}

TEST(Collapse, gets_rid_of_tiny_edges_among_crumpled_slivers) {
  // As a contour leaves them along borders: vertices much closer together than their own unevenness, so that
  // the triangles between them face anywhere.
  const double radius = 8 * length;
  FilmMesh mesh = shapes::double_bubble(radius, 11);
  const int n_triangles = mesh.n_triangles();
  for (int t = 0; t < n_triangles; t += 3) {
    const auto corner = mesh.triangle[t].vertex;
    shapes::split_edge(mesh, corner[t % 3], corner[(t + 1) % 3], 0.01);
  }
  Random random(3);
  const double by = 0.03 * length;
  for (auto& x : mesh.position)
    x += Vec3{random.uniform(-by, by), random.uniform(-by, by), random.uniform(-by, by)};
  WorkingMesh work(mesh);
  EXPECT_GT(collapse_short_edges(work, one_length, {}), 300);
  for (const MeshEdge& e : build_edges(mesh).edge)
    EXPECT_GT(norm(mesh.position[e.high] - mesh.position[e.low]), 0.25 * length);
  EXPECT_EQ(build_topology(mesh).n_nonconforming_edges, 0);
}

TEST(Collapse, does_not_pinch_a_thin_tube) {
  // A bubble drawn out to a prism of three sides: each ring of three edges is shorter than the tube is long.
  FilmMesh mesh;
  const int n_rings = 6;
  for (int k = 0; k < n_rings; ++k)
    for (int i = 0; i < 3; ++i) {
      const double angle = 2 * std::numbers::pi * i / 3;
      mesh.position.push_back(length * Vec3{0.2 * std::cos(angle), 0.2 * std::sin(angle), 0.8 * k});
    }
  for (int k = 0; k + 1 < n_rings; ++k)
    for (int i = 0; i < 3; ++i) {
      const int a = 3 * k + i, b = 3 * k + (i + 1) % 3;
      mesh.triangle.push_back(make_triangle(a, b, b + 3, 1, 0));
      mesh.triangle.push_back(make_triangle(a, b + 3, a + 3, 1, 0));
    }
  mesh.triangle.push_back(make_triangle(0, 2, 1, 1, 0));
  const int top = 3 * (n_rings - 1);
  mesh.triangle.push_back(make_triangle(top, top + 1, top + 2, 1, 0));
  WorkingMesh work(mesh);
  collapse_short_edges(work, one_length, {});
  EXPECT_EQ(build_topology(mesh).n_nonconforming_edges, 0);
  EXPECT_EQ(shapes::euler_characteristic(mesh, 1), 2);
}

TEST(Collapse, does_not_cut_a_septum_along_an_edge_between_two_border_vertices) {
  // A double bubble squeezed flat, its septum a strip of triangles from one side of the ring to the other.
  const double radius = 2 * length;
  FilmMesh mesh = shapes::double_bubble(radius, 4);
  const std::vector<int> ring = build_topology(mesh).border[0].vertices;
  const int n = static_cast<int>(ring.size()) - 1;
  std::vector<int> around(ring.begin(), ring.end() - 1);
  std::rotate(around.begin(),
              std::max_element(around.begin(), around.end(),
                               [&](int a, int b) { return mesh.position[a].y < mesh.position[b].y; }),
              around.end());
  std::erase_if(mesh.triangle, [](const FilmTriangle& t) { return t.phase_a == 1 && t.phase_b == 2; });
  const auto add = [&](int a, int b, int c) {
    const Vec3 normal = cross(mesh.position[b] - mesh.position[a], mesh.position[c] - mesh.position[a]);
    mesh.triangle.push_back(normal.x > 0 ? make_triangle(a, b, c, 1, 2) : make_triangle(a, c, b, 1, 2));
  };
  for (int k = 0; k < n / 2; ++k) {
    const int left = around[k], right = around[(n - k) % n];
    const int next_left = around[k + 1], next_right = around[n - k - 1];
    if (left != right) add(left, right, next_left);
    if (next_left != next_right) add(right, next_left, next_right);
  }
  drop_unused_vertices(mesh);
  ASSERT_EQ(build_topology(mesh).n_nonconforming_edges, 0);
  for (auto& x : mesh.position) x.z *= 0.1;
  WorkingMesh work(mesh);
  collapse_short_edges(work, one_length, {});
  const Topology topology = build_topology(mesh);
  EXPECT_EQ(topology.n_lamellae(), 3);
  EXPECT_EQ(topology.n_borders(), 1);
  EXPECT_EQ(topology.n_nonconforming_edges, 0);
  for (Phase p = 0; p <= 2; ++p) EXPECT_EQ(shapes::euler_characteristic(mesh, p), 2);
}

/// Two triangles along an edge that faces two obtuse angles: vertices 2 and 3.
FilmMesh flat_quad() {
  FilmMesh mesh;
  mesh.position = {{-length, 0, 0}, {length, 0, 0}, {0, 0.4 * length, 0}, {0, -0.4 * length, 0}};
  mesh.triangle = {make_triangle(0, 1, 2, 1, 2), make_triangle(1, 0, 3, 1, 2)};
  return mesh;
}

TEST(Flip, joins_a_border_with_a_film_but_not_with_a_border) {
  FilmMesh mesh = flat_quad();
  WorkingMesh work(mesh);
  work.phases[2] = work.phases[3] = PhaseSet{1, 2, 3};
  EXPECT_EQ(flip_edges(work), 0);
  work.phases[3] = PhaseSet{1, 2};
  EXPECT_EQ(flip_edges(work), 1);
  EXPECT_EQ(flip_edges(work), 0);
}

TEST(Flip, leaves_squares_alone) {
  FilmMesh mesh = flat_quad();
  mesh.position[2].y = 0.99 * length;
  mesh.position[3].y = -0.99 * length;
  WorkingMesh work(mesh);
  EXPECT_EQ(flip_edges(work), 0);  // the angles exceed π by 0.02 only
}

TEST(Flip, does_not_make_an_edge_twice) {
  FilmMesh mesh = flat_quad();  // closed underneath by the other diagonal
  mesh.triangle.push_back(make_triangle(2, 3, 0, 1, 2));
  mesh.triangle.push_back(make_triangle(3, 2, 1, 1, 2));
  WorkingMesh work(mesh);
  EXPECT_EQ(flip_edges(work), 0);
}

TEST(Flip, does_not_turn_a_triangle_over) {
  FilmMesh mesh = flat_quad();
  mesh.position[3] = {0.3 * length, 0.5 * length, 0};  // folded back over the other triangle, beyond it
  WorkingMesh work(mesh);
  EXPECT_EQ(flip_edges(work), 0);
}

TEST(Flip, keeps_to_one_film) {
  FilmMesh mesh = flat_quad();
  mesh.triangle[1].phase_b = 3;
  WorkingMesh work(mesh);
  EXPECT_EQ(flip_edges(work), 0);
}

TEST(Flip, does_not_trust_what_a_part_tells_of_a_vertex_on_its_cut) {
  FilmMesh mesh = flat_quad();
  std::swap(mesh.position[0], mesh.position[2]);  // the corner that the new edge would start from is first
  for (FilmTriangle& t : mesh.triangle)
    for (int& v : t.vertex)
      if (v == 0 || v == 2) v = 2 - v;
  FilmMesh other = mesh;
  {
    WorkingMesh work(mesh, 1);
    work.phases[3] = PhaseSet{1, 2, 3};  // on a border, and vertex 0 may be, too
    EXPECT_EQ(flip_edges(work), 0);
    work.phases[3] = PhaseSet{1, 2};
    EXPECT_EQ(flip_edges(work), 1);
  }
  // The edge is there already, but the triangles of vertex 0 beside it are not joined to the quad in this
  // part; those around vertex 3 are.
  const double back = -2 * length;
  other.position.insert(other.position.end(), {{length, 0, back}, {-length, 0, back}});
  for (const auto& [a, b] : {std::pair{2, 5}, {5, 0}, {0, 4}, {4, 1}})
    other.triangle.push_back(make_triangle(a, b, 3, 1, 2));
  const FilmMesh before = other;
  WorkingMesh work(other, 1);
  flip_edges(work);
  EXPECT_EQ(build_topology(other).n_nonconforming_edges, build_topology(before).n_nonconforming_edges);
}

TEST(Flip, in_runs_of_one_flipper_is_that_of_a_new_one_for_each) {
  const double radius = 8 * length;
  const FilmMesh cluster = shapes::four_bubbles(radius, 8);
  const Topology topology = build_topology(cluster);
  FilmMesh one = cluster, fresh = cluster;
  WorkingMesh work(one), fresh_work(fresh);
  EdgeFlipper flipper(work);
  Random random(5);
  int n_flipped = 0;
  for (int run = 0; run < 6; ++run) {
    for (int v = 0; v < one.n_vertices(); ++v) {
      const double by = 0.5 * length;
      const Vec3 away{random.uniform(-by, by), random.uniform(-by, by), random.uniform(-by, by)};
      one.position[v] = fresh.position[v] =
          shapes::on_four_bubbles(radius, one.position[v] + away, topology.vertex_phases[v]);
    }
    const int n = flipper.run();
    EXPECT_EQ(n, EdgeFlipper(fresh_work).run());
    n_flipped += n;
    for (int t = 0; t < one.n_triangles(); ++t) ASSERT_EQ(one.triangle[t].vertex, fresh.triangle[t].vertex);
    EXPECT_EQ(build_topology(one).n_nonconforming_edges, 0);
  }
  EXPECT_GT(n_flipped, one.n_triangles() / 2);  // many an edge more than once
}

TEST(Flip, goes_back_when_the_vertices_do) {
  FilmMesh mesh = flat_quad();
  WorkingMesh work(mesh);
  EdgeFlipper flipper(work);
  EXPECT_EQ(flipper.run(), 1);
  EXPECT_EQ(flipper.run(), 0);
  const auto is_joined = [&](int a, int b) {
    return std::ranges::any_of(build_edges(mesh).edge,
                               [&](const MeshEdge& e) { return e.low == a && e.high == b; });
  };
  EXPECT_TRUE(is_joined(2, 3));
  for (Vec3& x : mesh.position) x = {0.4 * x.x, 2.5 * x.y, 0};  // as high as it was wide
  EXPECT_EQ(flipper.run(), 1);
  EXPECT_EQ(flipper.run(), 0);
  EXPECT_TRUE(is_joined(0, 1));
}

TEST(WorkingMesh, vertices_on_a_cut_keep_their_numbers) {
  FilmMesh mesh = flat_quad();
  WorkingMesh work(mesh, 3);
  EXPECT_NO_THROW(work.remove({0, 1}));  // vertex 3 goes
  EXPECT_EQ(mesh.n_vertices(), 3);
  EXPECT_THROW(work.remove({1}), std::logic_error);
}

TEST(Smooth, moves_film_and_border_vertices_as_documented_and_junctions_not_at_all) {
  const double radius = 4 * length;
  FilmMesh mesh = shapes::four_bubbles(radius, 4);
  const FilmMesh before = mesh;
  const Topology topology = build_topology(mesh);
  WorkingMesh work(mesh);
  smooth(work, where_it_is);
  for (int v = 0; v < mesh.n_vertices(); ++v) {
    Vec3 sum;
    double weight = 0;
    if (topology.vertex_kind[v] == VertexKind::Film)
      for (int n = topology.star_offset[v]; n < topology.star_offset[v + 1]; ++n) {
        const int t = topology.star_triangle[n];
        for (int w : before.triangle[t].vertex) sum += triangle_area(before, t) / 3 * before.position[w];
        weight += triangle_area(before, t);
      }
    if (topology.vertex_kind[v] == VertexKind::Border)
      for (const BorderEdge& e : topology.border_edge)
        if (e.vertex[0] == v || e.vertex[1] == v) {
          const Vec3 a = before.position[e.vertex[0]], b = before.position[e.vertex[1]];
          sum += norm(b - a) / 2 * (a + b);
          weight += norm(b - a);
        }
    const Vec3 mean = weight > 0 ? sum / weight : before.position[v];
    const Vec3 expected = 0.3 * before.position[v] + 0.7 * mean;
    EXPECT_LT(norm(mesh.position[v] - expected), 1e-12 * radius);
  }
}

TEST(Split, cuts_a_border_edge_in_all_three_films_at_once) {
  const double radius = 4 * length;
  FilmMesh mesh = shapes::double_bubble(radius, 3);
  const int n_triangles = mesh.n_triangles();
  const BorderEdge edge = build_topology(mesh).border_edge[0];
  const Vec3 middle = 0.5 * (mesh.position[edge.vertex[0]] + mesh.position[edge.vertex[1]]);
  // Coarse everywhere but at the ends of this one edge, which alone is long for it then.
  const double reach = 0.6 * norm(mesh.position[edge.vertex[0]] - mesh.position[edge.vertex[1]]);
  const auto target = [&](const Vec3& x) { return norm(x - middle) < reach ? reach : 10 * reach; };
  const auto on_pair = [&](const Vec3& x, const PhaseSet& phases) -> std::optional<Vec3> {
    return shapes::on_double_bubble(radius, x, phases);
  };
  WorkingMesh work(mesh);
  EXPECT_EQ(split_long_edges(work, target, on_pair, 1.4), 1);
  EXPECT_EQ(mesh.n_triangles(), n_triangles + 3);
  EXPECT_TRUE((work.phases.back() == PhaseSet{0, 1, 2}));
  EXPECT_LT(norm(mesh.position.back() - shapes::on_double_bubble(radius, middle, {0, 1, 2})), 1e-12 * radius);
  EXPECT_EQ(build_topology(mesh).n_nonconforming_edges, 0);
  EXPECT_EQ(split_long_edges(work, target, on_pair, 1.4), 0);
}

TEST(Split, keeps_the_middle_where_there_is_no_projection) {
  FilmMesh mesh = fan({{1, 0, 0}, {0, 1, 0}, {-3, 0, 0}, {0, -1, 0}});
  WorkingMesh work(mesh);
  const auto nowhere = [](const Vec3&, const PhaseSet&) { return std::optional<Vec3>{}; };
  // 3 long inside, and the rim edges of √10: the longest of each triangle goes first.
  EXPECT_EQ(split_long_edges(work, one_length, nowhere, 2.5), 2);
  EXPECT_EQ(mesh.n_triangles(), 6);
  for (int v : {5, 6}) {
    EXPECT_NEAR(mesh.position[v].x, -1.5 * length, 1e-15 * length);
    EXPECT_TRUE(work.held[v]);
  }
}

/// A triangle on a base of 3 between two vertices of a cut, and what is beyond its two sides. In units of
/// `length`.
FilmMesh triangle_on_cut(double height) {
  FilmMesh mesh;
  for (const Vec3& x : {Vec3{-1.5, 0, 0}, {1.5, 0, 0}, {0, height, 0}, {1.2, height, 0}, {-1.2, height, 0}})
    mesh.position.push_back(length * x);
  mesh.triangle = {make_triangle(0, 1, 2, 1, 2), make_triangle(1, 3, 2, 1, 2), make_triangle(0, 2, 4, 1, 2)};
  return mesh;
}

TEST(Split, leaves_the_shorter_sides_beside_a_long_edge_that_must_stay) {
  // The sides are √3.25 = 1.8 and 4.27: the first, halved, would leave 1.5, 1.45 … across the triangle.
  FilmMesh low = triangle_on_cut(1), high = triangle_on_cut(4);
  WorkingMesh low_work(low, 2), high_work(high, 2);
  EXPECT_EQ(split_long_edges(low_work, one_length, where_it_is, 1.25), 0);
  EXPECT_EQ(split_long_edges(high_work, one_length, where_it_is, 1.25), 2);
  EXPECT_TRUE(std::ranges::any_of(high.triangle, [](const FilmTriangle& t) {
    return std::ranges::count_if(t.vertex, [](int v) { return v < 2; }) == 2 && t.vertex[2] >= 5;
  }));
}

TEST(Split, comes_to_an_end_beside_a_long_cut) {
  FilmMesh mesh = triangle_on_cut(4);
  WorkingMesh work(mesh, 2);
  int n_passes = 0;
  while (n_passes < 24 && split_long_edges(work, one_length, where_it_is, 1.25) > 0) ++n_passes;
  EXPECT_LT(n_passes, 8);
  for (int t = 0; t < mesh.n_triangles(); ++t)  // none below a fifth of an equilateral one
    EXPECT_GT(norm(doubled_area_normal(mesh, t)), 0.2 * 0.87 * length * length);
}

}  // namespace
}  // namespace spume::mesh
