#include "spume/mesh/volume_constraint.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

#include "spume/base/random.hpp"
#include "spume/mesh/measure.hpp"
#include "spume/mesh/topology.hpp"
#include "tests/support/film_shapes.hpp"

namespace spume::mesh {
namespace {

constexpr double radius = 3e-4;  // [m]

double largest_relative_error(const FilmMesh& mesh, const std::vector<double>& target) {
  const std::vector<double> volume = phase_volumes(mesh, static_cast<int>(target.size()));
  double largest = 0;
  for (std::size_t p = 1; p < target.size(); ++p)
    if (target[p] > 0) largest = std::max(largest, std::abs(volume[p] / target[p] - 1));
  return largest;
}

void shake(FilmMesh& mesh, double by) {
  Random random(5);
  for (auto& x : mesh.position)
    x += Vec3{random.uniform(-by, by), random.uniform(-by, by), random.uniform(-by, by)};
}

TEST(VolumeConstraint, restores_the_volumes_of_a_cluster_to_1e_9_in_three_iterations) {
  FilmMesh mesh = shapes::four_bubbles(radius, 8);
  std::vector<double> target = phase_volumes(mesh, 5);
  const double factor[] = {1, 1.002, 0.999, 0.998, 1.001};  // what a reconstruction leaves to correct
  for (int p = 1; p < 5; ++p) target[p] *= factor[p];
  const double largest = restore_volumes(mesh, target, 3, radius);
  EXPECT_LT(largest_relative_error(mesh, target), 1e-9);
  // 0.2 % of the volume over the surface of a bubble is about 0.0003 radius.
  EXPECT_GT(largest, 1e-4 * radius);
  EXPECT_LT(largest, 2e-3 * radius);
}

TEST(VolumeConstraint, a_sphere_grows_evenly) {
  const Vec3 centre{1e-3, 2e-3, -1e-3};
  FilmMesh mesh = shapes::sphere(centre, radius, 3, 1);
  const double volume = phase_volumes(mesh, 2)[1];
  const std::vector<double> target{0, 1.1 * volume};
  restore_volumes(mesh, target, 8, radius);
  EXPECT_LT(largest_relative_error(mesh, target), 1e-12);
  // Every vertex at the cube root of 1.1 of its distance; normals of the mesh differ from radial ones by
  // O(h/R).
  for (const Vec3& x : mesh.position) EXPECT_NEAR(norm(x - centre) / radius, std::cbrt(1.1), 2e-4);
}

TEST(VolumeConstraint, converges_on_rough_meshes) {
  FilmMesh mesh = shapes::double_bubble(radius, 10);
  const double volume = 9 * std::numbers::pi / 8 * radius * radius * radius;
  shake(mesh, 0.01 * radius);
  const std::vector<double> target{0, volume, volume};
  restore_volumes(mesh, target, 6, radius);
  EXPECT_LT(largest_relative_error(mesh, target), 1e-9);
  EXPECT_EQ(build_topology(mesh).n_nonconforming_edges, 0);
}

TEST(VolumeConstraint, phases_without_a_target_take_up_what_the_others_give) {
  FilmMesh mesh = shapes::double_bubble(radius, 8);
  const std::vector<double> before = phase_volumes(mesh, 3);
  const std::vector<double> target{0, 1.01 * before[1], 0};
  restore_volumes(mesh, target, 6, radius);
  const std::vector<double> after = phase_volumes(mesh, 3);
  EXPECT_NEAR(after[1] / target[1], 1, 1e-9);
  // The septum is 3/4 π R² of the 15/4 π R² of film around bubble 1 and moves as far as the rest of it.
  EXPECT_NEAR((before[2] - after[2]) / (after[1] - before[1]), 0.2, 0.02);
}

TEST(VolumeConstraint, a_group_without_path_to_the_outside_is_not_singular) {
  // A bubble 3 inside a bubble 2 that nothing else bounds: one film, from 2 (all around) into 3.
  FilmMesh mesh = shapes::sphere({}, radius, 3, 3);
  for (auto& t : mesh.triangle) t.phase_a = 2;
  const double volume = phase_volumes(mesh, 4)[3];
  const std::vector<double> target{0, 0, volume, 1.01 * volume};
  restore_volumes(mesh, target, 5, radius);
  EXPECT_NEAR(phase_volumes(mesh, 4)[3] / target[3], 1, 1e-9);
}

TEST(VolumeConstraint, no_vertex_moves_farther_than_it_may) {
  FilmMesh mesh = shapes::double_bubble(radius, 8);
  const FilmMesh before = mesh;
  const std::vector<double> target{0, 8 * radius * radius * radius, 2 * radius * radius * radius};
  const double step = 0.01 * radius;
  EXPECT_DOUBLE_EQ(restore_volumes(mesh, target, 1, step), step);
  for (int v = 0; v < mesh.n_vertices(); ++v)
    EXPECT_LE(norm(mesh.position[v] - before.position[v]),
              step * (1 + 1e-9));  // round-off of the subtraction
}

}  // namespace
}  // namespace spume::mesh
