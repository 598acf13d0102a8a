#include <gtest/gtest.h>
#include <mpi.h>

#include <limits>

#include "spume/base/error.hpp"
#include "tests/unit/flow/whole_flow.hpp"

namespace spume {
namespace {

using grid::Boundary;

TEST(NavierStokes, GivesTheSameFlowOnAnyNumberOfRanks) {
  for (const auto& boundary : {std::array{Boundary::Periodic, Boundary::Periodic, Boundary::Periodic},
                               std::array{Boundary::Slip, Boundary::Periodic, Boundary::Wall}}) {
    const grid::Box box = testing::cube(16, boundary);
    const auto together = testing::after_steps(parallel::Communicator::world(), box, 5, {});
    const auto alone = testing::after_steps(parallel::Communicator(MPI_COMM_SELF), box, 5, {});
    for (int c = 0; c < 3; ++c)
      EXPECT_LT(testing::largest_difference(together[c], alone[c]), 1e-12 * testing::flow_speed);
    EXPECT_LT(testing::largest_difference(together[3], alone[3]),
              1e-12 * state::Gas{}.density * testing::flow_speed * testing::flow_speed);
  }
}

TEST(NavierStokes, AStepThatIsNotFiniteIsANumericalError) {
  const grid::Grid grid(parallel::Communicator::world(), testing::cube(16, Boundary::Periodic));
  state::GasFlow gas_flow(grid);
  grid::VectorField force(grid);
  if (grid.communicator().is_root()) force[0].values()[5] = std::numeric_limits<double>::quiet_NaN();
  flow::NavierStokes navier_stokes(grid, state::Gas{}, {});
  EXPECT_THROW(navier_stokes.step(gas_flow, force, 1e-4), NumericalError);
}

}  // namespace
}  // namespace spume
