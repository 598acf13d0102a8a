#include <gtest/gtest.h>

#include "analytic_foams.hpp"
#include "spume/interface/reconstruct.hpp"

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
}

}  // namespace
}  // namespace spume::interface
