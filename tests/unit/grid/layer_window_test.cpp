#include "spume/grid/layer_window.hpp"

#include <gtest/gtest.h>

#include <limits>

#include "boxes.hpp"

namespace spume::grid {
namespace {

using parallel::Communicator;

class LayerWindowOn : public testing::TestWithParam<NamedBox> {};
INSTANTIATE_TEST_SUITE_P(Boxes, LayerWindowOn, testing::ValuesIn(test_boxes()),
                         [](const auto& test) { return test.param.name; });

/// Values in the three layers of a window around k, and in their ghosts, that are not those of `expected`.
int count_wrong(const LayerWindow& window, const Index3& n, int k, const Ghosted<3>& expected) {
  int n_wrong = 0;
  for (int layer = k - 1; layer <= k + 1; ++layer)
    for (int j = -1; j <= n.j; ++j)
      for (int i = -1; i <= n.i; ++i) n_wrong += window.row(j, layer)[i] != expected(i, j, layer);
  return n_wrong;
}

TEST_P(LayerWindowOn, SeesWhatACopyWithGhostsHoldsWhileTheFieldIsOverwrittenBehindIt) {
  const Grid grid(Communicator::world(), GetParam().box);
  const std::size_t layer = static_cast<std::size_t>(grid.cells().i) * grid.cells().j;
  for (int depth : {1, 2}) {
    LayerWindow window(grid, depth);
    for (const Symmetry& symmetry : symmetries(grid.box())) {
      Field f(grid, symmetry);
      fill_random(f, 3);
      const Ghosted<3> expected(f);
      int n_wrong = 0, n_layers = 0;
      window.open(f);
      for (int k = window.first(); k <= window.last(); ++k, ++n_layers) {
        window.move_to(k);
        n_wrong += count_wrong(window, grid.cells(), k, expected);
        if (k < grid.z_begin() || k >= grid.z_end()) continue;
        std::fill_n(f.values().begin() + static_cast<std::ptrdiff_t>((k - grid.z_begin()) * layer), layer,
                    std::numeric_limits<double>::quiet_NaN());
      }
      EXPECT_EQ(n_wrong, 0);
      EXPECT_GE(n_layers, grid.z_end() - grid.z_begin());
    }
  }
}

TEST_P(LayerWindowOn, SeesLayersBesideTheOwnedOnesUnlessAWallIsBetween) {
  const Grid grid(Communicator::world(), GetParam().box);
  const bool periodic = grid.box().boundary[2] == Boundary::Periodic;
  const LayerWindow window(grid, 2);
  EXPECT_EQ(window.first(), grid.z_begin() - (periodic || grid.z_begin() > 0 ? 1 : 0));
  EXPECT_EQ(window.last(), grid.z_end() - (periodic || grid.z_end() < grid.cells().k ? 0 : 1));
}

TEST_P(LayerWindowOn, ValuesOnFacesGoOnToAWallThatHoldsZero) {
  const Grid grid(Communicator::world(), GetParam().box);
  const Index3 n = grid.cells();
  for (int axis = 0; axis < 3; ++axis) {
    Field f(grid);
    f.fill(1);
    LayerWindow window(grid);
    window.open(f, axis);
    for (int k = window.first(); k <= window.last(); ++k) window.move_to(k);
    const int top = grid.z_end() - 1;
    const double beyond = axis == 0   ? window.row(0, top)[n.i]
                          : axis == 1 ? window.row(n.j, top)[0]
                                      : window.row(0, top + 1)[0];
    const bool wall = grid.box().boundary[axis] != Boundary::Periodic && (axis < 2 || grid.z_end() == n.k);
    EXPECT_EQ(beyond, wall ? 0 : 1);
  }
}

}  // namespace
}  // namespace spume::grid
