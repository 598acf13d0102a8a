#include "spume/interface/carry.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "analytic_foams.hpp"
#include "spume/grid/loops.hpp"

namespace spume::interface {
namespace {

using testing::h;

TEST(Carry, MovesFilmsRigidlyInUniformFlow) {
  const grid::Grid grid(parallel::Communicator::world(), testing::cube_box(16));
  grid::VectorField u(grid);
  u[0].fill(0.3);
  u[2].fill(-0.1);
  auto films = testing::icosphere({}, 4 * h, 1);
  const auto before = films;
  carry(films, u, {}, 1e-4);
  for (int v = 0; v < films.n_vertices(); ++v)
    // The kernel's weights add up to one: round-off.
    EXPECT_LT(norm(films.position[v] - before.position[v] - Vec3{0.3e-4, 0, -0.1e-4}), 1e-13 * h);
}

/// Distance of a vertex carried through steady cellular flow for a time in n steps from where many steps take
/// it.
Vec3 carried(int n_steps) {
  const grid::Grid grid(parallel::Communicator::world(), testing::cube_box(16));
  grid::VectorField u(grid);
  const double k = 2 * std::numbers::pi / (16 * h);
  auto ux = grid::owned(u[0]), uy = grid::owned(u[1]);
  grid::for_each_cell(grid, [&](int i, int j, int l) {
    const Vec3 x = grid.centre(i, j, l);
    ux(i, j, l) = std::sin(k * x.x) * std::cos(k * x.y);
    uy(i, j, l) = -std::cos(k * x.x) * std::sin(k * x.y);
  });
  mesh::FilmMesh films{{{1.3 * h, 2.1 * h, 0}}, {}, {}};
  const grid::KernelCoupling kernel{.placement = grid::Placement::Centres};
  for (int n = 0; n < n_steps; ++n) carry(films, u, kernel, 4 * h / n_steps);
  return films.position[0];
}

TEST(Carry, IsOfSecondOrderInTime) {
  const Vec3 exact = carried(8192);
  // Steps well below a cell: the kernel's second derivative jumps where a cell enters it.
  const double coarse = norm(carried(64) - exact), fine = norm(carried(512) - exact);
  EXPECT_NEAR(std::log2(coarse / fine) / 3, 2.0, 0.1);
}

}  // namespace
}  // namespace spume::interface
