#include "spume/grid/layer_window.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <utility>

#include "boxes.hpp"

namespace spume::grid {
namespace {

using parallel::Communicator;

class LayerWindowOn : public testing::TestWithParam<NamedBox> {};
INSTANTIATE_TEST_SUITE_P(Boxes, LayerWindowOn, testing::ValuesIn(test_boxes()),
                         [](const auto& test) { return test.param.name; });

/// Values in the layers of a window around k, and in their ghosts, that are not those of `expected`.
int count_wrong(const LayerWindow& window, const Index3& n, int k, int reach, const Ghosted<3>& expected) {
  int n_wrong = 0;
  for (int layer = k - reach; layer <= k + reach; ++layer)
    for (int j = -reach; j < n.j + reach; ++j)
      for (int i = -reach; i < n.i + reach; ++i) n_wrong += window.row(j, layer)[i] != expected(i, j, layer);
  return n_wrong;
}

TEST_P(LayerWindowOn, SeesWhatACopyWithGhostsHoldsWhileTheFieldIsOverwrittenBehindIt) {
  const Grid grid(Communicator::world(), GetParam().box);
  const std::size_t layer = static_cast<std::size_t>(grid.cells().i) * grid.cells().j;
  for (const auto& [reach, beyond] : {std::pair{1, 0}, {1, 1}, {2, 0}, {2, 1}}) {
    LayerWindow window(grid, reach, beyond);
    for (const Symmetry& symmetry : symmetries(grid.box())) {
      Field f(grid, symmetry);
      fill_random(f, 3);
      const Ghosted<3> expected(f);
      int n_wrong = 0, n_layers = 0;
      window.open(f);
      for (int k = window.first(); k <= window.last(); ++k, ++n_layers) {
        window.move_to(k);
        n_wrong += count_wrong(window, grid.cells(), k, reach, expected);
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
  const LayerWindow window(grid, 1, 1);
  EXPECT_EQ(window.first(), grid.z_begin() - (periodic || grid.z_begin() > 0 ? 1 : 0));
  EXPECT_EQ(window.last(), grid.z_end() - (periodic || grid.z_end() < grid.cells().k ? 0 : 1));
}

TEST_P(LayerWindowOn, ValuesOnFacesGoOnAsAnOddFunctionAboutWallsThatHoldZero) {
  const Grid grid(Communicator::world(), GetParam().box);
  const Index3 n = grid.cells();
  for (int axis = 0; axis < 3; ++axis) {
    const bool wall = grid.box().boundary[axis] != Boundary::Periodic;
    Field f(grid, velocity_symmetry(grid.box(), axis));
    const OwnedView face = owned(f);
    for (int k = grid.z_begin(); k < grid.z_end(); ++k)
      for (int j = 0; j < n.j; ++j)
        for (int i = 0; i < n.i; ++i) face(i, j, k) = Index3{i, j, k}[axis];
    LayerWindow window(grid, 2);
    Field lost(grid);
    lost.fill(std::numeric_limits<double>::quiet_NaN());
    window.open(lost);
    for (int k = window.first(); k <= window.last(); ++k) window.move_to(k);
    window.open(f, axis);
    const auto at = [&](int place) {  // along the axis
      return axis == 0   ? window.row(0, grid.z_begin())[place]
             : axis == 1 ? window.row(place, grid.z_begin())[0]
                         : window.row(0, place)[0];
    };
    window.move_to(grid.z_begin());
    if (axis < 2 || grid.z_begin() == 0) {
      EXPECT_EQ(at(-1), wall ? -1 : n[axis] - 1);
      EXPECT_EQ(at(-2), wall ? -2 : n[axis] - 2);
    }
    if (axis == 2) window.move_to(grid.z_end() - 1);
    if (axis < 2 || grid.z_end() == n.k) {
      EXPECT_EQ(at(n[axis]), 0);
      EXPECT_EQ(at(n[axis] + 1), wall ? 1 - n[axis] : 1);
    }
  }
}

}  // namespace
}  // namespace spume::grid
