#include <gtest/gtest.h>

#include <optional>

#include "spume/mesh/remesh.hpp"
#include "spume/mesh/topology.hpp"
#include "tests/support/film_shapes.hpp"
#include "tests/support/same_mesh.hpp"

namespace spume::mesh {
namespace {

constexpr double radius = 0.002;  // [m]

// Four slabs, half a radius thick, which is 14 times the longest target, and three seams. On one rank this
// compares a run with itself.
TEST(Remesh, DoesNotDependOnTheNumberOfRanks) {
  const FilmMesh fine = shapes::sphere({0, 0, 0}, radius, 6, 1);
  const double edge = norm(fine.edge(fine.triangle[0].vertex[0], fine.triangle[0].vertex[1]));
  const auto target = [edge](const Vec3& x) { return (1.5 + 0.5 * x.z / radius) * edge; };
  const auto onto_sphere = [](const Vec3& x, const PhaseSet&) {
    return std::optional(radius * normalized(x));
  };
  FilmMesh together = fine, alone = fine;
  RemeshParameters in_slabs;
  in_slabs.least_slab = fine.n_vertices() / 4;
  const auto report = remesh(together, target, onto_sphere, in_slabs, parallel::Communicator::world());
  const auto report_alone = remesh(alone, target, onto_sphere, in_slabs);
  EXPECT_GT(report.n_collapsed, 10000);
  EXPECT_EQ(report.n_collapsed, report_alone.n_collapsed);
  EXPECT_EQ(report.n_flipped, report_alone.n_flipped);
  ASSERT_NO_FATAL_FAILURE(spume::testing::assert_same_mesh(together, alone));
  EXPECT_EQ(build_topology(together).n_nonconforming_edges, 0);
}

}  // namespace
}  // namespace spume::mesh
