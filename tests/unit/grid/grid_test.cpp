#include "spume/grid/grid.hpp"

#include <gtest/gtest.h>

#include <string>

#include "boxes.hpp"
#include "spume/base/error.hpp"

namespace spume::grid {
namespace {

using parallel::Communicator;

TEST(Grid, SlabsOfAllRanksTileTheBoxInOrder) {
  for (const int layers : {24, 19, 27}) {
    const Communicator world = Communicator::world();
    const Grid grid(world, make_box({8, 6, layers}, {}));
    const int block = (layers + world.size() - 1) / world.size();
    EXPECT_EQ(grid.z_begin(), block * world.rank());
    EXPECT_EQ(grid.z_end(), std::min(layers, block * (world.rank() + 1)));
    EXPECT_EQ(grid.owned_size(), std::size_t(8 * 6) * (grid.z_end() - grid.z_begin()));
    EXPECT_EQ(grid.total_size(), std::size_t(8 * 6) * layers);
    EXPECT_EQ(world.sum(double(grid.owned_size())), double(grid.total_size()));
  }
}

TEST(Grid, CentresLieHalfACellFromTheFaces) {
  const Grid grid(Communicator::world(), make_box({8, 6, 24}, {}));
  const Box& box = grid.box();
  const double h = grid.h();
  // Round-off of coordinates of a few 1e-4 m.
  EXPECT_NEAR(norm(grid.centre(0, 0, 0) - (box.lower + Vec3{h / 2, h / 2, h / 2})), 0, 1e-18);
  EXPECT_NEAR(norm(grid.centre(7, 5, 23) - (box.upper - Vec3{h / 2, h / 2, h / 2})), 0, 1e-18);
}

TEST(Grid, TooManyRanksIsAnInputErrorThatNamesHowManyWork) {
  const Communicator world = Communicator::world();
  if (world.size() == 1) GTEST_SKIP() << "one rank is never too many";
  const int layers = 4 * world.size() - 1;
  try {
    const Grid grid(world, make_box({8, 6, layers}, {}));
    FAIL() << "no error";
  } catch (const InputError& error) {
    // 7 layers: one rank; 15 layers: three ranks with 5 layers each.
    const std::string expected = world.size() == 2   ? "works is 1"
                                 : world.size() == 4 ? "works is 3"
                                                     : "works is";
    EXPECT_NE(std::string(error.what()).find(expected), std::string::npos) << error.what();
  }
}

TEST(Grid, FewerThanFourCellsInADirectionIsAnInputError) {
  EXPECT_THROW(Grid(Communicator::world(), make_box({3, 8, 24}, {})), InputError);
  EXPECT_THROW(Grid(Communicator::world(), make_box({8, 8, 3}, {})), InputError);
}

TEST(Grid, CellsThatAreNotCubesBreakTheContract) {
  Box box = make_box({8, 8, 24}, {});
  box.upper.z += 0.01 * box.spacing() * 24;
  EXPECT_THROW(Grid(Communicator::world(), box), std::logic_error);
}

TEST(Box, IsPeriodicOnlyWhenEveryDirectionIs) {
  constexpr auto P = Boundary::Periodic;
  EXPECT_TRUE(make_box({4, 4, 4}, {P, P, P}).is_periodic());
  EXPECT_FALSE(make_box({4, 4, 4}, {P, P, Boundary::Slip}).is_periodic());
  EXPECT_FALSE(make_box({4, 4, 4}, {Boundary::Wall, P, P}).is_periodic());
}

TEST(VelocitySymmetry, IsOddAtNoSlipWallsAndForTheNormalComponentAtSlipWalls) {
  const Box box = make_box({4, 4, 4}, {Boundary::Periodic, Boundary::Wall, Boundary::Slip});
  constexpr auto E = Parity::Even, O = Parity::Odd;
  EXPECT_EQ(velocity_symmetry(box, 0), (Symmetry{E, O, E}));
  EXPECT_EQ(velocity_symmetry(box, 1), (Symmetry{E, O, E}));
  EXPECT_EQ(velocity_symmetry(box, 2), (Symmetry{E, O, O}));
}

}  // namespace
}  // namespace spume::grid
