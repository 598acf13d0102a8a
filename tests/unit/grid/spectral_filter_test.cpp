#include "spume/grid/spectral_filter.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "boxes.hpp"

namespace spume::grid {
namespace {

using parallel::Communicator;

class SpectralFilterOn : public testing::TestWithParam<NamedBox> {};
INSTANTIATE_TEST_SUITE_P(Boxes, SpectralFilterOn, testing::ValuesIn(test_boxes()),
                         [](const auto& test) { return test.param.name; });

// Round-off of a transform pair: a few ulp of the largest value, which is 1.
constexpr double round_off = 1e-14;

TEST_P(SpectralFilterOn, FactorOneGivesTheFieldBack) {
  const Grid grid(Communicator::world(), GetParam().box);
  for (const Symmetry& symmetry : symmetries(grid.box())) {
    const SpectralFilter filter(grid, symmetry, [](const Vec3&) { return 1.0; });
    Field f(grid, symmetry), g(grid, symmetry);
    fill_random(f, 1);
    filter.apply(f, g);
    EXPECT_LT(largest_difference(f, g), round_off);
  }
}

TEST_P(SpectralFilterOn, EveryModeIsMultipliedByTheFactorOfItsOwnPhaseAdvance) {
  const Grid grid(Communicator::world(), GetParam().box);
  // Distinguishes the directions.
  const auto factor = [](const Vec3& theta) {
    return 0.2 + theta.x + 3 * theta.y * theta.y + std::cos(theta.z);
  };
  for (const Symmetry& symmetry : symmetries(grid.box())) {
    const SpectralFilter filter(grid, symmetry, factor);
    for (const Index3& number : {Index3{1, 2, 3}, Index3{4, 1, 2}, Index3{3, 5, 7}}) {
      Field f(grid, symmetry), g(grid, symmetry);
      fill_mode(f, number);
      filter.apply(f, g);
      const Vec3 theta{mode_theta(grid.box(), 0, number.i), mode_theta(grid.box(), 1, number.j),
                       mode_theta(grid.box(), 2, number.k)};
      for (double& value : f.values()) value *= factor(theta);
      EXPECT_LT(largest_difference(f, g), 20 * round_off);  // the factor reaches 20
    }
  }
}

TEST_P(SpectralFilterOn, FactorAtZeroMultipliesTheMean) {
  const Grid grid(Communicator::world(), GetParam().box);
  const SpectralFilter mean_only(grid, even_symmetry,
                                 [](const Vec3& theta) { return theta == Vec3{} ? 2.0 : 0.0; });
  Field f(grid);
  fill_random(f, 2);
  const double mean = sum(f) / double(grid.total_size());
  mean_only.apply(f, f);
  for (double& value : f.values()) value -= 2 * mean;
  EXPECT_LT(max_abs(f), round_off);
}

TEST_P(SpectralFilterOn, FiltersThatShareATransformDoNotDisturbEachOther) {
  const Grid grid(Communicator::world(), GetParam().box);
  const SpectralFilter twice(grid, even_symmetry, [](const Vec3&) { return 2.0; });
  const SpectralFilter half(grid, even_symmetry, [](const Vec3&) { return 0.5; });
  Field f(grid), g(grid);
  fill_random(f, 3);
  twice.apply(f, g);
  half.apply(g, g);
  EXPECT_LT(largest_difference(f, g), 2 * round_off);
}

TEST(SpectralFilter, RunsRepeatToTheLastBit) {
  for (const NamedBox& named : test_boxes()) {
    const Grid first(Communicator::world(), named.box), second(Communicator::world(), named.box);
    const auto factor = [](const Vec3& theta) { return std::exp(-dot(theta, theta)); };
    Field f(first), g(second);
    fill_random(f, 4);
    fill_random(g, 4);
    SpectralFilter(first, even_symmetry, factor).apply(f, f);
    SpectralFilter(second, even_symmetry, factor).apply(g, g);
    EXPECT_EQ(gather(f), gather(g));
  }
}

}  // namespace
}  // namespace spume::grid
