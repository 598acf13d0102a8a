#include <gtest/gtest.h>

#include "analytic_foams.hpp"
#include "spume/interface/contour.hpp"
#include "spume/interface/reconstruct.hpp"
#include "tests/support/same_mesh.hpp"

namespace spume::interface {
namespace {

using testing::h;

// Run on one rank this compares a run with itself; on more, with one rank alone.
TEST(Reconstruct, DoesNotDependOnTheNumberOfRanks) {
  const grid::Box box = testing::cube_box(36);
  const grid::Grid together(parallel::Communicator::world(), box),
      alone(parallel::Communicator(MPI_COMM_SELF), box);
  const auto foam = testing::power_diagram(testing::tetrahedral_cluster(8 * h));
  auto phases = testing::unset_phases(4), phases_alone = phases;
  auto a = construct(together, foam, phases, {});
  auto b = construct(alone, foam, phases_alone, {});
  a = reconstruct(together, a.films, phases, {});
  b = reconstruct(alone, b.films, phases_alone, {});
  ASSERT_EQ(a.films.n_vertices(), b.films.n_vertices());
  ASSERT_EQ(a.films.n_triangles(), b.films.n_triangles());
  for (int v = 0; v < a.films.n_vertices(); ++v)
    ASSERT_LT(norm(a.films.position[v] - b.films.position[v]), 1e-10 * h) << v;
  for (int t = 0; t < a.films.n_triangles(); ++t)
    ASSERT_EQ(a.films.triangle[t].vertex, b.films.triangle[t].vertex);

  const mesh::Topology topology = mesh::build_topology(a.films);
  EXPECT_EQ(a.topology.star_triangle, topology.star_triangle);
  EXPECT_EQ(a.topology.corner_dof, topology.corner_dof);
  EXPECT_EQ(a.topology.triangle_lamella, topology.triangle_lamella);
}

// Flat films along the axes, whose quadrilaterals in tetrahedra have two diagonals of one length, in a box
// that is periodic: the layers of cubes of the last rank go on at the first.
TEST(Contour, DoesNotDependOnTheNumberOfRanks) {
  const grid::Box box = testing::cube_box(24);
  const auto layer_of_two = [](mesh::Phase p, const Vec3& x) {
    const double inside = 7.3 * h - (12 * h - std::abs(x.z));  // about the face of the box
    if (p == 0) return -inside;
    return inside - std::max(0.0, p == 1 ? x.x - 0.3 * h : 0.3 * h - x.x);
  };
  const auto potentials = testing::sampled(box, layer_of_two, 3);
  const auto winners = find_winners(potentials);
  const auto together = contour(parallel::Communicator::world(), potentials, winners),
             alone = contour(parallel::Communicator::self(), potentials, winners);
  ASSERT_GT(alone.n_triangles(), 2000);
  ASSERT_NO_FATAL_FAILURE(spume::testing::assert_same_mesh(together, alone));
}

}  // namespace
}  // namespace spume::interface
