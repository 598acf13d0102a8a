#include "spume/grid/field.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numeric>

#include "boxes.hpp"

namespace spume::grid {
namespace {

using parallel::Communicator;

class FieldOn : public testing::TestWithParam<NamedBox> {};
INSTANTIATE_TEST_SUITE_P(Boxes, FieldOn, testing::ValuesIn(test_boxes()),
                         [](const auto& test) { return test.param.name; });

template <int W>
double largest_ghost_error(const Grid& grid, const Symmetry& symmetry, const Index3& number) {
  Field f(grid, symmetry);
  fill_mode(f, number);
  const auto ghosts = ghosted<W>(f);
  const Index3 n = grid.cells();
  double error = 0;
  for (int k = grid.z_begin() - W; k < grid.z_end() + W; ++k)
    for (int j = -W; j < n.j + W; ++j)
      for (int i = -W; i < n.i + W; ++i)
        error = std::max(error, std::abs(ghosts(i, j, k) - mode(grid.box(), symmetry, number, i, j, k)));
  return error;
}

// Periodic, even and odd modes continue across the faces by their own formula, so ghosts on faces, edges and
// corners are compared with the formula there. Round-off: a few ulp of a phase below 50.
TEST_P(FieldOn, GhostsContinueModesOfEverySymmetryOverFacesEdgesAndCorners) {
  const Grid grid(Communicator::world(), GetParam().box);
  for (const Symmetry& symmetry : symmetries(grid.box())) {
    EXPECT_LT(largest_ghost_error<1>(grid, symmetry, {1, 2, 3}), 1e-13);
    EXPECT_LT(largest_ghost_error<2>(grid, symmetry, {3, 1, 2}), 1e-13);
    EXPECT_LT(largest_ghost_error<4>(grid, symmetry, {2, 3, 1}), 1e-13);
  }
}

TEST_P(FieldOn, GhostsKeepEveryBitOfTheCellsTheyCopy) {
  const Grid grid(Communicator::world(), GetParam().box);
  Field f(grid);
  fill_random(f, 5);
  const Index3 n = grid.cells();
  const std::vector<double> whole = gather(f);
  const auto source = [&](int m, int axis) {
    if (grid.box().boundary[axis] == Boundary::Periodic) return (m + n[axis]) % n[axis];
    return m < 0 ? -1 - m : m >= n[axis] ? 2 * n[axis] - 1 - m : m;
  };
  const auto ghosts = ghosted<3>(f);
  int n_wrong = 0;
  for (int k = grid.z_begin() - 3; k < grid.z_end() + 3; ++k)
    for (int j = -3; j < n.j + 3; ++j)
      for (int i = -3; i < n.i + 3; ++i)
        n_wrong +=
            ghosts(i, j, k) != whole[(std::size_t(source(k, 2)) * n.j + source(j, 1)) * n.i + source(i, 0)];
  EXPECT_EQ(n_wrong, 0);
}

TEST_P(FieldOn, UpdateOfGhostsSeesNewValues) {
  const Grid grid(Communicator::world(), GetParam().box);
  Field f(grid);
  auto ghosts = ghosted<2>(f);
  f.fill(3.0);
  ghosts.update(f);
  EXPECT_EQ(ghosts(-2, -2, grid.z_begin() - 2), 3.0);
  EXPECT_EQ(*(ghosts.at(0, 0, grid.z_begin()) - ghosts.stride_z() - ghosts.stride_y()), 3.0);
}

TEST_P(FieldOn, GatherIsOrderedByIJKAndScatterIsItsInverse) {
  const Grid grid(Communicator::world(), GetParam().box);
  const Index3 n = grid.cells();
  Field f(grid);
  for_each_cell(grid, [&](int i, int j, int k) { owned(f)(i, j, k) = (k * n.j + j) * n.i + i; });
  const std::vector<double> whole = gather(f);
  std::vector<double> expected(grid.total_size());
  std::iota(expected.begin(), expected.end(), 0.0);
  EXPECT_EQ(whole, expected);
  Field back(grid);
  scatter(whole, back);
  EXPECT_EQ(largest_difference(back, f), 0);
}

TEST_P(FieldOn, SumIsTheSameToTheLastBitOnAnyNumberOfRanks) {
  const Grid grid(Communicator::world(), GetParam().box);
  const Grid serial(Communicator(MPI_COMM_SELF), GetParam().box);
  Field f(grid), f_serial(serial);
  fill_random(f, 11);
  fill_random(f_serial, 11);
  EXPECT_EQ(sum(f), sum(f_serial));
  EXPECT_NE(sum(f), 0);
}

TEST(Field, MaxAbsFindsTheLargestSizeOnAnyRank) {
  const Grid grid(Communicator::world(), test_boxes()[0].box);
  Field f(grid);
  for_each_cell(grid,
                [&](int i, int j, int k) { owned(f)(i, j, k) = i == 3 && j == 4 && k == 20 ? -2.5 : 1.0; });
  EXPECT_EQ(max_abs(f), 2.5);
}

TEST(Field, MaxAbsOfAFieldWithNaNIsInfinite) {
  const Grid grid(Communicator::world(), test_boxes()[0].box);
  Field f(grid);
  for_each_cell(grid, [&](int i, int, int k) {
    owned(f)(i, 0, k) = i == 3 && k == 0 ? std::numeric_limits<double>::quiet_NaN() : 1.0;
  });
  EXPECT_EQ(max_abs(f), std::numeric_limits<double>::infinity());
}

}  // namespace
}  // namespace spume::grid
