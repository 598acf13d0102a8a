#include "spume/mesh/remesh.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>
#include <utility>

#include "spume/base/random.hpp"
#include "spume/mesh/measure.hpp"
#include "spume/mesh/quality.hpp"
#include "spume/mesh/topology.hpp"
#include "tests/support/film_shapes.hpp"
#include "tests/support/short_edges.hpp"

namespace spume::mesh {
namespace {

constexpr double radius = 3e-4;  // [m], the size of a bubble in a real foam
constexpr double double_bubble_area = 27 * std::numbers::pi / 4 * radius * radius;

TargetLength uniform(double length) {
  return [length](const Vec3&) { return length; };
}
std::optional<Vec3> on_pair(const Vec3& x, const PhaseSet& phases) {
  return shapes::on_double_bubble(radius, x, phases);
}
std::optional<Vec3> on_cluster(const Vec3& x, const PhaseSet& phases) {
  return shapes::on_four_bubbles(radius, x, phases);
}
std::optional<Vec3> on_sphere(const Vec3& x, const PhaseSet&) {
  return radius * normalized(x);
}
std::optional<Vec3> where_it_is(const Vec3& x, const PhaseSet&) {
  return x;
}
std::optional<Vec3> nowhere(const Vec3&, const PhaseSet&) {
  return std::nullopt;
}

/// Moves every vertex about by part of an edge and back onto its film or border: needles, caps, tiny edges.
void shake(FilmMesh& mesh, double by, const Projection& project) {
  const Topology topology = build_topology(mesh);
  Random random(11);
  for (int v = 0; v < mesh.n_vertices(); ++v) {
    const Vec3 away{random.uniform(-by, by), random.uniform(-by, by), random.uniform(-by, by)};
    mesh.position[v] = *project(mesh.position[v] + away, topology.vertex_phases[v]);
  }
}

/// New vertices very near one end of every seventh edge of the mesh (of the border as of the films).
void plant_tiny_edges(FilmMesh& mesh, double fraction, const Projection& project) {
  const int n_vertices = mesh.n_vertices(), n_triangles = mesh.n_triangles();
  for (int t = 0; t < n_triangles; t += 7) {
    const auto corner = mesh.triangle[t].vertex;
    shapes::split_edge(mesh, corner[t % 3], corner[(t + 1) % 3], fraction);
  }
  const Topology topology = build_topology(mesh);
  for (int v = n_vertices; v < mesh.n_vertices(); ++v)
    mesh.position[v] = *project(mesh.position[v], topology.vertex_phases[v]);
}

struct Counts {
  int lamellae, borders, junctions, nonconforming;
  bool operator==(const Counts&) const = default;
};
Counts counts_of(const FilmMesh& mesh) {
  const Topology t = build_topology(mesh);
  return {t.n_lamellae(), t.n_borders(), t.n_junctions(), t.n_nonconforming_edges};
}

void expect_same_foam(const FilmMesh& mesh, const Counts& before, int n_bubbles) {
  EXPECT_TRUE(counts_of(mesh) == before);
  EXPECT_EQ(before.nonconforming, 0);
  for (Phase p = 0; p <= n_bubbles; ++p) EXPECT_EQ(shapes::euler_characteristic(mesh, p), 2) << "phase " << p;
}

bool are_identical(const FilmMesh& a, const FilmMesh& b) {
  if (a.position != b.position || a.n_triangles() != b.n_triangles()) return false;
  for (int t = 0; t < a.n_triangles(); ++t)
    if (a.triangle[t].vertex != b.triangle[t].vertex || a.triangle[t].phase_a != b.triangle[t].phase_a ||
        a.triangle[t].phase_b != b.triangle[t].phase_b)
      return false;
  return true;
}

/// A fine, shaken mesh of the double bubble with tiny edges, about 5 triangles per square of the target
/// length.
FilmMesh rough_double_bubble(double target) {
  const double edge = 0.6 * target;
  FilmMesh mesh = shapes::double_bubble(radius, static_cast<int>(0.9 * radius / edge));
  shake(mesh, 0.3 * edge, on_pair);
  plant_tiny_edges(mesh, 0.02, on_pair);
  return mesh;
}

TEST(Remesh, coarsens_a_rough_double_bubble_without_changing_what_it_is) {
  const double target = radius / 8;
  FilmMesh mesh = rough_double_bubble(target);
  const Counts before = counts_of(mesh);
  EXPECT_EQ(before.lamellae, 3);
  EXPECT_EQ(before.borders, 1);
  EXPECT_LT(measure_quality(mesh, build_topology(mesh)).smallest_angle_degrees, 1.0);

  const RemeshReport report = remesh(mesh, uniform(target), on_pair, {});
  EXPECT_GT(report.n_collapsed, 100);
  EXPECT_EQ(report.n_split, 0);
  EXPECT_EQ(n_short_edges(mesh, uniform(target)), 0);
  expect_same_foam(mesh, before, 2);
  const Quality quality = measure_quality(mesh, build_topology(mesh));
  EXPECT_GT(quality.smallest_angle_degrees, 15);  // 18 degrees is what such remeshing gives on fresh contours
  EXPECT_GT(quality.median_angle_degrees, 40);
  EXPECT_GT(quality.shortest_edge, 0.4 * target);
  EXPECT_LT(quality.longest_edge, 1.9 * target);  // smoothing comes after the limit of 1.8
  EXPECT_EQ(quality.n_inverted, 0);
  // Equilateral triangles of edge h fill a sphere with √3/4 h² each: 2.3 per h².
  EXPECT_NEAR(mesh.n_triangles() * target * target / film_area(mesh), 2.3, 0.8);
}

TEST(Remesh, area_error_falls_with_the_square_of_the_target) {
  const auto area_error = [](double target) {
    FilmMesh mesh = rough_double_bubble(target);
    remesh(mesh, uniform(target), on_pair, {});
    return 1 - film_area(mesh) / double_bubble_area;
  };
  const double coarse = area_error(radius / 6), fine = area_error(radius / 12);
  // Equilateral triangles inscribed in a sphere lose 5/24 (h/R)² of its area; edges are up to 1.8 targets
  // long.
  EXPECT_GT(fine, 0.1 / 144);
  EXPECT_LT(fine, 0.6 / 144);
  EXPECT_NEAR(std::log2(coarse / fine), 2, 0.4);  // the mean edge over the target varies by some per cent
}

TEST(Remesh, keeps_the_junctions_and_borders_of_a_cluster) {
  FilmMesh mesh = shapes::four_bubbles(radius, 14);
  shake(mesh, 0.02 * radius, on_cluster);
  plant_tiny_edges(mesh, 0.02, on_cluster);
  const Counts before = counts_of(mesh);
  ASSERT_TRUE((before == Counts{10, 10, 5, 0}));
  const double target = radius / 8;
  const RemeshReport report = remesh(mesh, uniform(target), on_cluster, {});
  EXPECT_GT(report.n_collapsed, 500);
  EXPECT_EQ(n_short_edges(mesh, uniform(target)), 0);
  expect_same_foam(mesh, before, 4);
  const Topology topology = build_topology(mesh);
  EXPECT_GT(measure_quality(mesh, topology).smallest_angle_degrees, 15);
  EXPECT_EQ(measure_quality(mesh, topology).n_inverted, 0);
  // Straight borders stay exactly as long as they are; junctions never move.
  const std::vector<double> length = border_lengths(mesh, topology);
  for (int b = 0; b < topology.n_borders(); ++b) {
    if (topology.border[b].phases[0] == 0) continue;
    EXPECT_NEAR(length[b], shapes::four_bubble_border * radius, 1e-9 * radius);
  }
}

TEST(Remesh, removes_tiny_edges_planted_on_the_border) {
  FilmMesh mesh = shapes::double_bubble(radius, 8);
  const double target = 0.9 * radius / 8;
  const PlateauBorder ring = build_topology(mesh).border[0];
  const int n_before = mesh.n_vertices();
  for (int n = 0; n < 5; ++n) shapes::split_edge(mesh, ring.vertices[6 * n], ring.vertices[6 * n + 1], 0.01);
  ASSERT_LT(measure_quality(mesh, build_topology(mesh)).shortest_edge, 0.02 * target);

  RemeshParameters parameters;
  parameters.collapse_below = 0.3;
  const RemeshReport report = remesh(mesh, uniform(target), on_pair, parameters);
  EXPECT_EQ(report.n_collapsed, 5);
  EXPECT_EQ(mesh.n_vertices(), n_before);
  EXPECT_GT(measure_quality(mesh, build_topology(mesh)).shortest_edge, 0.5 * target);
  EXPECT_EQ(build_topology(mesh).border_edge.size(), ring.vertices.size() - 1);
}

/// A sphere with one vertex more, in the middle of a triangle; its number is the lowest or the highest.
FilmMesh sphere_with_needless_vertex(bool lowest) {
  FilmMesh mesh = shapes::sphere({}, radius, 2, 1);
  const int extra = mesh.n_vertices();
  const FilmTriangle t = mesh.triangle[17];
  const auto [a, b, c] = t.vertex;
  mesh.position.push_back(radius * normalized(mesh.position[a] + mesh.position[b] + mesh.position[c]));
  mesh.triangle[17].vertex = {a, b, extra};
  mesh.triangle.push_back({{b, c, extra}, t.phase_a, t.phase_b});
  mesh.triangle.push_back({{c, a, extra}, t.phase_a, t.phase_b});
  if (lowest) {
    std::swap(mesh.position[0], mesh.position[extra]);
    for (auto& s : mesh.triangle)
      for (int& v : s.vertex) v = v == 0 ? extra : v == extra ? 0 : v;
  }
  return mesh;
}

TEST(Remesh, removes_film_vertices_of_three_triangles_whatever_their_edges) {
  const double target =
      0.15 * radius;  // the shortest edge is 1.1 of that: none is short, and 2.2 is the longest
  RemeshParameters parameters;
  parameters.smoothing_sweeps = 0;
  for (bool lowest : {false, true}) {
    FilmMesh mesh = sphere_with_needless_vertex(lowest);
    ASSERT_GT(measure_quality(mesh, build_topology(mesh)).shortest_edge, target);
    const RemeshReport report = remesh(mesh, uniform(target), on_sphere, parameters);
    EXPECT_EQ(report.n_collapsed, 1);
    EXPECT_EQ(mesh.n_triangles(), 320);
  }
}

TEST(Remesh, splitting_brings_all_edges_to_the_target) {
  const double target = radius / 16;
  RemeshParameters parameters;
  parameters.split_above = 1.4;
  FilmMesh mesh = shapes::four_bubbles(radius, 4);
  const Counts before = counts_of(mesh);
  const RemeshReport report = remesh(mesh, uniform(target), on_cluster, parameters);
  EXPECT_GT(report.n_split, 1000);
  EXPECT_EQ(n_short_edges(mesh, uniform(target)), 0);
  expect_same_foam(mesh, before, 4);
  const Quality quality = measure_quality(mesh, build_topology(mesh));
  EXPECT_GT(quality.smallest_angle_degrees, 20);
  EXPECT_GT(quality.shortest_edge, 0.4 * target);
  EXPECT_LT(quality.longest_edge, 1.6 * target);  // the last smoothing comes after the last split
  EXPECT_EQ(quality.n_inverted, 0);
  // New vertices are on the exact surfaces, so the area is that of a fine mesh: 5/24 (h/R)² as above.
  const double lost = 1 - film_area(mesh) / (shapes::four_bubble_area * radius * radius);
  EXPECT_GT(lost, 0);
  EXPECT_LT(lost, 0.4 / 256);
}

TEST(Remesh, half_the_target_makes_four_times_the_triangles) {
  RemeshParameters parameters;
  parameters.split_above = 1.4;
  const auto n_triangles = [&](double target) {
    FilmMesh mesh = shapes::double_bubble(radius, 4);
    remesh(mesh, uniform(target), on_pair, parameters);
    return static_cast<double>(mesh.n_triangles());
  };
  EXPECT_NEAR(n_triangles(radius / 20) / n_triangles(radius / 10), 4,
              0.8);  // edges may differ by 10 % in targets
}

TEST(Remesh, follows_a_target_graded_towards_the_border) {
  const double fine = radius / 40, coarse = radius / 8;
  const auto target = [&](const Vec3& x) {
    const Vec3 ring = shapes::on_double_bubble(radius, x, PhaseSet{0, 1, 2});
    return std::min(coarse, fine + 0.3 * norm(x - ring));
  };
  RemeshParameters parameters;
  parameters.split_above = 1.4;
  FilmMesh mesh = shapes::double_bubble(radius, 8);
  const Counts before = counts_of(mesh);
  remesh(mesh, target, on_pair, parameters);
  expect_same_foam(mesh, before, 2);
  const Topology topology = build_topology(mesh);
  EXPECT_GT(measure_quality(mesh, topology).smallest_angle_degrees, 15);
  const double mean_border_edge = border_lengths(mesh, topology)[0] / topology.border_edge.size();
  EXPECT_NEAR(mean_border_edge / fine, 1, 0.3);
  EXPECT_GT(measure_quality(mesh, topology).longest_edge, coarse);
}

TEST(Remesh, a_second_time_changes_next_to_nothing) {
  const double target = radius / 12;
  RemeshParameters parameters;
  parameters.split_above = 1.4;
  FilmMesh mesh = shapes::double_bubble(radius, 6);
  remesh(mesh, uniform(target), on_pair, parameters);
  const int n_before = mesh.n_triangles();
  const RemeshReport again = remesh(mesh, uniform(target), on_pair, parameters);
  EXPECT_LT(again.n_split + again.n_collapsed, n_before / 50);
}

TEST(Remesh, two_runs_are_identical_to_the_last_bit) {
  RemeshParameters parameters;
  parameters.split_above = 1.4;
  FilmMesh first = rough_double_bubble(radius / 8), second = first;
  remesh(first, uniform(radius / 8), on_pair, parameters);
  remesh(second, uniform(radius / 8), on_pair, parameters);
  EXPECT_TRUE(are_identical(first, second));
}

TEST(Remesh, does_the_same_in_any_unit_of_length) {
  const double target = radius / 8;
  FilmMesh mesh = rough_double_bubble(target), scaled = mesh;
  for (auto& x : scaled.position) x *= 1024;  // a power of two: the same digits
  const auto project = [](const Vec3& x, const PhaseSet& phases) -> std::optional<Vec3> {
    return 1024 * shapes::on_double_bubble(radius, x / 1024, phases);
  };
  remesh(mesh, uniform(target), on_pair, {});
  remesh(scaled, uniform(1024 * target), project, {});
  for (auto& x : scaled.position) x *= 1.0 / 1024;
  EXPECT_TRUE(are_identical(mesh, scaled));
}

TEST(Remesh, vertices_that_cannot_be_projected_stay) {
  FilmMesh mesh = shapes::double_bubble(radius, 8);
  const FilmMesh before = mesh;
  RemeshParameters parameters;
  parameters.collapse_below = 0;
  remesh(mesh, uniform(0.1 * radius), nowhere, parameters);
  EXPECT_EQ(mesh.position, before.position);
}

/// A flat film in the unit square (times the radius) with its edge free, nodes at random heights along y.
FilmMesh open_film(int n) {
  FilmMesh mesh;
  Random random(3);
  for (int j = 0; j <= n; ++j)
    for (int i = 0; i <= n; ++i) {
      const bool inside = i > 0 && i < n && j > 0 && j < n;
      const double dx = inside ? random.uniform(-0.4, 0.4) : 0, dy = inside ? random.uniform(-0.4, 0.4) : 0;
      mesh.position.push_back({radius * (i + dx) / n, radius * (j + dy) / n, 0});
    }
  for (int j = 0; j < n; ++j)
    for (int i = 0; i < n; ++i) {
      const int v = j * (n + 1) + i;
      mesh.triangle.push_back(make_triangle(v, v + 1, v + n + 2, 0, 1));
      mesh.triangle.push_back(make_triangle(v, v + n + 2, v + n + 1, 0, 1));
    }
  return mesh;
}

TEST(Remesh, the_rim_of_an_open_film_stays_where_it_is) {
  FilmMesh mesh = open_film(16);
  remesh(mesh, uniform(radius / 10), where_it_is, {});
  EXPECT_LT(mesh.n_triangles(), 400);                                      // of 512
  EXPECT_NEAR(film_area(mesh), radius * radius, 1e-12 * radius * radius);  // no gap, no fold
  int n_rim = 0;
  for (const Vec3& x : mesh.position) n_rim += x.x == 0 || x.x == radius || x.y == 0 || x.y == radius;
  EXPECT_EQ(n_rim, 64);
}

TEST(Remesh, flips_an_edge_that_faces_two_obtuse_angles) {
  FilmMesh mesh;
  const double h = radius / 10;
  mesh.position = {{-h, 0, 0}, {h, 0, 0}, {0, 0.4 * h, 0}, {0, -0.4 * h, 0}};
  mesh.triangle = {make_triangle(0, 1, 2, 1, 2), make_triangle(1, 0, 3, 1, 2)};
  RemeshParameters parameters;
  parameters.collapse_below = 0;
  const RemeshReport report = remesh(mesh, uniform(h), where_it_is, parameters);
  EXPECT_EQ(report.n_flipped, 1);
  for (int t = 0; t < 2; ++t) {
    EXPECT_GT(doubled_area_normal(mesh, t).z, 0);  // the sides of the film have not changed
    const auto& v = mesh.triangle[t].vertex;
    EXPECT_EQ(std::count(v.begin(), v.end(), 2) + std::count(v.begin(), v.end(), 3), 2);
  }
}

TEST(Remesh, does_not_join_two_bubbles_corners_by_collapsing_a_tetrahedron) {
  FilmMesh mesh;
  mesh.position = {{0, 0, 0}, {radius, 0, 0}, {0, radius, 0}, {0, 0, radius}};
  mesh.triangle = {make_triangle(0, 2, 1, 1, 0), make_triangle(0, 1, 3, 1, 0), make_triangle(0, 3, 2, 1, 0),
                   make_triangle(1, 2, 3, 1, 0)};
  const RemeshReport report = remesh(mesh, uniform(10 * radius), where_it_is, {});
  EXPECT_EQ(report.n_collapsed, 0);  // two triangles back to back would be left
  EXPECT_EQ(n_short_edges(mesh, uniform(10 * radius)), 6);
  EXPECT_EQ(mesh.n_triangles(), 4);
}

TEST(Remesh, refuses_parameters_that_undo_each_other_and_targets_of_zero) {
  FilmMesh mesh = shapes::sphere({}, radius, 1, 1);
  RemeshParameters parameters;
  parameters.split_above = 1.2;
  EXPECT_THROW(remesh(mesh, uniform(radius), on_sphere, parameters), std::logic_error);
  EXPECT_THROW(remesh(mesh, uniform(0), on_sphere, {}), std::logic_error);
}

}  // namespace
}  // namespace spume::mesh
