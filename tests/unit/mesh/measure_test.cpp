#include "spume/mesh/measure.hpp"

#include <gtest/gtest.h>

#include "spume/base/random.hpp"

namespace spume::mesh {
namespace {

/// Two unit cubes side by side, bubbles 1 (x < 0) and 2 (x > 0), far from the origin.
FilmMesh two_cubes() {
  FilmMesh mesh;
  const auto vertex = [](int i, int j, int k) { return (k * 2 + j) * 3 + i; };
  for (int k = 0; k < 2; ++k)
    for (int j = 0; j < 2; ++j)
      for (int i = 0; i < 3; ++i)
        mesh.position.push_back(Vec3{i - 1.0, j * 1.0, k * 1.0} + Vec3{100, 50, -70});
  const auto quad = [&](int a, int b, int c, int d, Phase p, Phase q) {  // counter-clockwise seen from q
    mesh.triangle.push_back(make_triangle(a, b, c, p, q));
    mesh.triangle.push_back(make_triangle(a, c, d, p, q));
  };
  for (int i = 0; i < 2; ++i) {
    const Phase p = i + 1;
    const auto v = [&](int di, int j, int k) { return vertex(i + di, j, k); };
    quad(v(0, 0, 0), v(0, 1, 0), v(1, 1, 0), v(1, 0, 0), p, 0);
    quad(v(0, 0, 1), v(1, 0, 1), v(1, 1, 1), v(0, 1, 1), p, 0);
    quad(v(0, 0, 0), v(1, 0, 0), v(1, 0, 1), v(0, 0, 1), p, 0);
    quad(v(0, 1, 0), v(0, 1, 1), v(1, 1, 1), v(1, 1, 0), p, 0);
  }
  quad(vertex(0, 0, 0), vertex(0, 0, 1), vertex(0, 1, 1), vertex(0, 1, 0), 1, 0);
  quad(vertex(2, 0, 0), vertex(2, 1, 0), vertex(2, 1, 1), vertex(2, 0, 1), 2, 0);
  quad(vertex(1, 0, 0), vertex(1, 1, 0), vertex(1, 1, 1), vertex(1, 0, 1), 1, 2);
  return mesh;
}

void shake(FilmMesh& mesh, double by) {
  Random random(7);
  for (auto& x : mesh.position)
    x += Vec3{random.uniform(-by, by), random.uniform(-by, by), random.uniform(-by, by)};
}

TEST(Measure, volumes_and_areas_of_two_cubes) {
  const FilmMesh mesh = two_cubes();
  ASSERT_EQ(build_topology(mesh).n_nonconforming_edges, 0);
  const auto volume = phase_volumes(mesh, 3);
  EXPECT_NEAR(volume[1], 1, 1e-13);
  EXPECT_NEAR(volume[2], 1, 1e-13);
  EXPECT_NEAR(volume[0], -2, 1e-13);
  EXPECT_NEAR(film_area(mesh), 11, 1e-13);
  EXPECT_NEAR(phase_areas(mesh, 3)[1], 6, 1e-13);
}

TEST(Measure, lumped_areas_and_lengths_add_up) {
  FilmMesh mesh = two_cubes();
  shake(mesh, 0.1);
  const Topology topology = build_topology(mesh);
  double area = 0, lamella_area = 0, length = 0, border_length = 0;
  for (double a : film_dof_areas(mesh, topology)) area += a;
  for (double a : lamella_areas(mesh, topology)) lamella_area += a;
  for (double l : border_dof_lengths(mesh, topology)) length += l;
  for (double l : border_lengths(mesh, topology)) border_length += l;
  EXPECT_NEAR(area, film_area(mesh), 1e-13 * area);
  EXPECT_NEAR(lamella_area, area, 1e-13 * area);
  EXPECT_NEAR(length, border_length, 1e-13 * length);
}

// Both gradients against central differences of step δ: the error is δ² times a third derivative of order
// one.
TEST(Measure, gradients_of_area_and_volume_agree_with_differences) {
  FilmMesh mesh = two_cubes();
  shake(mesh, 0.1);
  const std::vector<double> value{0, 1.5, -0.5};
  const auto descent = area_descent(mesh);
  const auto gradient = weighted_volume_gradient(mesh, value);
  const double delta = 1e-4;
  const auto weighted_volume = [&] {
    const auto volume = phase_volumes(mesh, 3);
    return value[1] * volume[1] + value[2] * volume[2];
  };
  for (int v = 0; v < mesh.n_vertices(); ++v)
    for (int d = 0; d < 3; ++d) {
      const double x = mesh.position[v][d];
      mesh.position[v][d] = x + delta;
      const double area_up = film_area(mesh), volume_up = weighted_volume();
      mesh.position[v][d] = x - delta;
      const double area_down = film_area(mesh), volume_down = weighted_volume();
      mesh.position[v][d] = x;
      EXPECT_NEAR(-descent[v][d], (area_up - area_down) / (2 * delta), 100 * delta * delta);
      EXPECT_NEAR(gradient[v][d], (volume_up - volume_down) / (2 * delta), 100 * delta * delta);
    }
}

/// Splits every triangle in four; new vertices at edge midpoints, pushed onto the unit sphere about the
/// origin.
FilmMesh refined_sphere(int levels) {
  FilmMesh mesh;
  mesh.position = {{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}};
  for (int sx = 0; sx < 2; ++sx)
    for (int sy = 2; sy < 4; ++sy)
      for (int sz = 4; sz < 6; ++sz) {
        const bool even = (sx + sy + sz) % 2 == 0;
        mesh.triangle.push_back(even ? make_triangle(sx, sy, sz, 1, 0) : make_triangle(sx, sz, sy, 1, 0));
      }
  for (int level = 0; level < levels; ++level) {
    std::vector<FilmTriangle> fine;
    const int n = mesh.n_vertices();
    std::vector<int> middle(static_cast<std::size_t>(n) * n, -1);
    const auto midpoint = [&](int a, int b) {
      int& m = middle[static_cast<std::size_t>(std::min(a, b)) * n + std::max(a, b)];
      if (m < 0) {
        m = mesh.n_vertices();
        mesh.position.push_back(normalized(mesh.position[a] + mesh.position[b]));
      }
      return m;
    };
    for (const auto& t : mesh.triangle) {
      const auto [a, b, c] = t.vertex;
      const int ab = midpoint(a, b), bc = midpoint(b, c), ca = midpoint(c, a);
      for (const auto& corner : {std::array{a, ab, ca}, {ab, b, bc}, {ca, bc, c}, {ab, bc, ca}})
        fine.push_back({corner, t.phase_a, t.phase_b});
    }
    mesh.triangle = fine;
  }
  return mesh;
}

// Young–Laplace for a film of tension 1 on a sphere of radius 1: P = 2. The error of an inscribed mesh is
// second order.
TEST(Measure, film_pressure_of_a_sphere_converges_at_second_order) {
  double error[3];
  for (int level = 2; level < 5; ++level) {
    const FilmMesh mesh = refined_sphere(level);
    const Topology topology = build_topology(mesh);
    error[level - 2] = film_pressures(mesh, topology, area_descent(mesh), 2)[1] - 2;
  }
  for (int n = 0; n < 2; ++n) EXPECT_NEAR(std::log2(std::abs(error[n] / error[n + 1])), 2, 0.2);
  EXPECT_LT(std::abs(error[2]), 0.01);
}

TEST(Measure, forces_that_are_a_pure_pressure_are_found_exactly) {
  FilmMesh mesh = refined_sphere(3);
  const std::vector<double> pressure{0, -3};
  const auto force = weighted_volume_gradient(mesh, pressure);
  EXPECT_NEAR(film_pressures(mesh, build_topology(mesh), force, 2)[1], 3, 1e-12);
}

}  // namespace
}  // namespace spume::mesh
