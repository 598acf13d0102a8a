#include "spume/interface/potentials.hpp"

#include <gtest/gtest.h>

#include "analytic_foams.hpp"

namespace spume::interface {
namespace {

using testing::h;

TEST(PhasePotentials, InterpolateCubicPolynomialsExactly) {
  const grid::Box box = testing::cube_box(12);
  const auto cubic = [](mesh::Phase p, const Vec3& x) {
    const Vec3 u = x / h;
    return p == 0 ? 0.0 : h * (u.x * u.x * u.x + 2 * u.y * u.y * u.z - u.x * u.z + 3);
  };
  const auto potentials = testing::sampled(box, cubic, 2);
  const Vec3 x{0.31 * h, -1.77 * h, 2.4 * h}, u = x / h;
  Vec3 gradient;
  const double value = potentials.difference(*potentials.find(1), *potentials.find(0), x, gradient);
  EXPECT_NEAR(value, 0.5 * cubic(1, x), 1e-12 * h);
  // ∂/∂x of the cubic, halved; round-off over values of 100 h.
  EXPECT_NEAR(gradient.x, 0.5 * (3 * u.x * u.x - u.z), 1e-11);
  EXPECT_NEAR(gradient.y, 2 * u.y * u.z, 1e-11);
  EXPECT_NEAR(gradient.z, 0.5 * (2 * u.y * u.y - u.x), 1e-11);
}

/// Four cones around the corners of a tetrahedron: smooth where they meet.
Vec3 corner(int p) {
  constexpr std::array<Vec3, 4> corners{Vec3{1, 1, 1}, {1, -1, -1}, {-1, 1, -1}, {-1, -1, 1}};
  return 5 * h * corners[p];
}
double cone(mesh::Phase p, const Vec3& x) {
  return -2 * norm(x - corner(p));
}

TEST(PhasePotentials, ProjectPutsPointsOnFilmsBordersAndJunctions) {
  const auto potentials = testing::sampled(testing::cube_box(24), cone, 4);
  for (const mesh::PhaseSet& phases : {mesh::PhaseSet{0, 1}, {0, 1, 2}, {0, 1, 2, 3}}) {
    const auto x = potentials.project({0.2 * h, -0.1 * h, 0.15 * h}, phases);
    ASSERT_TRUE(x);
    // The interpolation error of a cone 8 cells from its tip.
    for (int m = 1; m < phases.size(); ++m) EXPECT_NEAR(cone(phases[0], *x), cone(phases[m], *x), 1e-3 * h);
  }
  // The junction is at the centre by symmetry of the four functions.
  EXPECT_LT(norm(*potentials.project({0.2 * h, -0.1 * h, 0.15 * h}, {0, 1, 2, 3})), 1e-3 * h);
}

TEST(PhasePotentials, ProjectRefusesLongMoves) {
  const auto potentials = testing::sampled(testing::cube_box(24), cone, 4);
  const Vec3 towards = normalized(corner(0) - corner(1));
  EXPECT_TRUE(potentials.project(0.4 * h * towards, {0, 1}));
  EXPECT_FALSE(potentials.project(0.7 * h * towards, {0, 1}));
  EXPECT_FALSE(potentials.project({}, {0, 9})) << "a phase without field";
}

}  // namespace
}  // namespace spume::interface
