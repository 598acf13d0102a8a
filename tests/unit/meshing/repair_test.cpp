#include "spume/meshing/repair.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "spume/base/random.hpp"
#include "spume/mesh/quality.hpp"
#include "spume/meshing/figures.hpp"
#include "tests/support/film_shapes.hpp"

namespace spume::meshing {
namespace {

constexpr double radius = 3e-4;  // [m]
constexpr int n_edges = 8;       // of the ring, over 6
constexpr double edge = 0.9 * radius / n_edges;

std::optional<Vec3> on_pair(const Vec3& x, const mesh::PhaseSet& phases) {
  return shapes::on_double_bubble(radius, x, phases);
}

/// A double bubble to be spoilt, and repaired with targets of its own edges.
class Repaired : public ::testing::Test {
 protected:
  void repair_it() {
    const mesh::Topology before = mesh::build_topology(films);
    {
      mesh::WorkingMesh work(films);
      StarMesh star_mesh(work);
      const std::vector<double> target(films.n_vertices(), edge);
      report = repair(star_mesh, on_pair, target, 30);
      expect_normals_up_to_date(work, star_mesh);
    }
    const mesh::Topology after = mesh::build_topology(films);
    EXPECT_EQ(after.n_nonconforming_edges, 0);
    EXPECT_EQ(after.n_lamellae(), before.n_lamellae());
    EXPECT_EQ(after.n_borders(), before.n_borders());
    for (mesh::Phase p = 0; p <= 2; ++p) EXPECT_EQ(shapes::euler_characteristic(films, p), 2);
    const auto figures = figures_of(films, after, on_pair);
    EXPECT_EQ(figures.n_turned, 0);
    EXPECT_GT(figures.smallest_angle_degrees, 25);
    EXPECT_LT(figures.film_distance, 1e-10 * radius);
  }
  /// Sweeps the dead triangles out, too.
  static void expect_normals_up_to_date(mesh::WorkingMesh& work, const StarMesh& changed) {
    std::vector<Vec3> kept;
    for (int t = 0; t < changed.films.n_triangles(); ++t)
      if (!changed.dead[t]) kept.push_back(changed.film_normal(t));
    work.remove(changed.dead);
    const StarMesh anew(work);
    ASSERT_EQ(static_cast<int>(kept.size()), work.mesh.n_triangles());
    for (int t = 0; t < work.mesh.n_triangles(); ++t)
      EXPECT_LT(norm(kept[t] - anew.film_normal(t)), 1e-12 * edge * edge);
  }
  double smallest_angle() const {
    return mesh::measure_quality(films, mesh::build_topology(films)).smallest_angle_degrees;
  }

  mesh::FilmMesh films = shapes::double_bubble(radius, n_edges);
  RepairReport report;
};

TEST_F(Repaired, takes_out_vertices_that_crowd_others) {
  for (int t = 3; t < 200; t += 40) {
    const auto corner = films.triangle[t].vertex;
    const int v = shapes::split_edge(films, corner[0], corner[1], 0.05);
    films.position[v] = *on_pair(films.position[v], mesh::build_topology(films).vertex_phases[v]);
  }
  ASSERT_LT(smallest_angle(), 5);
  repair_it();
}

TEST_F(Repaired, absorbs_a_vertex_that_lies_on_a_border_but_for_a_hair) {
  const mesh::Topology topology = mesh::build_topology(films);
  const auto& e = topology.border_edge.front();
  const auto& vertex = films.triangle[e.triangle[0]].vertex;
  const int apex = *std::find_if(vertex.begin(), vertex.end(),
                                 [&](int v) { return v != e.vertex[0] && v != e.vertex[1]; });
  const Vec3 middle = films.position[e.vertex[0]] + 0.5 * films.edge(e.vertex[0], e.vertex[1]);
  films.position[apex] =
      *on_pair(middle + 0.05 * (films.position[apex] - middle), topology.vertex_phases[apex]);
  ASSERT_LT(smallest_angle(), 12);
  repair_it();
}

TEST_F(Repaired, moves_vertices_that_stand_badly) {
  const mesh::Topology topology = mesh::build_topology(films);
  Random random(4);
  const auto push = [&] { return edge * random.uniform(-0.3, 0.3); };
  for (int v = 0; v < films.n_vertices(); v += 2)
    films.position[v] = *on_pair(films.position[v] + Vec3{push(), push(), push()}, topology.vertex_phases[v]);
  ASSERT_LT(smallest_angle(), 22);
  repair_it();
  EXPECT_GT(report.n_moved, 0);
}

TEST_F(Repaired, leaves_a_good_mesh_alone) {
  const std::vector<Vec3> before = films.position;
  mesh::WorkingMesh work(films);
  StarMesh star_mesh(work);
  const std::vector<double> target(films.n_vertices(), edge);
  report = repair(star_mesh, on_pair, target, 20);
  EXPECT_EQ(report.n_moved + report.n_flipped + report.n_collapsed + report.n_absorbed + report.n_left, 0);
  EXPECT_EQ(films.position, before);
}

}  // namespace
}  // namespace spume::meshing
