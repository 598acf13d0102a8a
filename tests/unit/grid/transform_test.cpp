#include "spume/grid/transform.hpp"

#include <gtest/gtest.h>

#include <vector>

#include "boxes.hpp"

namespace spume::grid {
namespace {

using parallel::Communicator;

class TransformOn : public testing::TestWithParam<NamedBox> {};
INSTANTIATE_TEST_SUITE_P(Boxes, TransformOn, testing::ValuesIn(test_boxes()),
                         [](const auto& test) { return test.param.name; });

/// A random field without its high modes; the factor depends on all three directions.
Field filtered(const Grid& grid, const Symmetry& symmetry, Transform::Exchange exchange) {
  Field f(grid, symmetry);
  fill_random(f, 4);
  Transform transform(grid, symmetry, exchange);
  std::vector<double> factor(transform.theta(0).size());
  for (int pass = 0; pass < 2; ++pass)
    transform.filter(f, f, [&](int row) {
      const double yz =
          transform.theta(1)[transform.mode_y(row)] + 2 * transform.theta(2)[transform.mode_z(row)];
      for (std::size_t m = 0; m < factor.size(); ++m)
        factor[m] = transform.normalisation() / (1 + yz + 3 * transform.theta(0)[m]);
      return factor.data();
    });
  return f;
}

TEST_P(TransformOn, SharedMemoryAndMessagesGiveTheSameBits) {
  const Communicator world = Communicator::world();
  const Grid grid(world, GetParam().box);
  if (world.size() == 1) GTEST_SKIP() << "one rank exchanges nothing";
  if (!parallel::SharedMemory::among(world, 4 * Field(grid).values().size()))
    GTEST_SKIP() << "no room for shared memory on this machine";
  for (const Symmetry& symmetry : symmetries(grid.box())) {
    const Field shared = filtered(grid, symmetry, Transform::Exchange::SharedMemory),
                sent = filtered(grid, symmetry, Transform::Exchange::Messages);
    EXPECT_GT(max_abs(sent), 0);
    EXPECT_EQ(largest_difference(shared, sent), 0);
  }
}

}  // namespace
}  // namespace spume::grid
