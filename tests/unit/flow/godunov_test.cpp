#include "spume/flow/godunov.hpp"

#include <gtest/gtest.h>

#include "spume/flow/projection.hpp"
#include "spume/flow/slopes.hpp"
#include "tests/unit/flow/smooth_flow.hpp"

namespace spume {
namespace {

using grid::Boundary;

const auto world = parallel::Communicator::world;

TEST(Slopes, AreExactForCubicsWhenNotLimited) {
  const grid::Grid grid(world(), testing::cube(16, Boundary::Periodic));
  const flow::BlockLayout layout(grid);
  flow::BlockArray u(layout), slope(layout);
  const auto cubic = [](double x) { return 2 + x * (3 + x * (0.5 - 0.25 * x)); };
  for (int axis = 0; axis < 3; ++axis) {
    const flow::CellRange all = layout.owned().grown(flow::margin);
    for (int k = all.lower.k; k < all.upper.k; ++k)
      for (int j = all.lower.j; j < all.upper.j; ++j)
        for (int i = all.lower.i; i < all.upper.i; ++i)
          u.first()[layout.offset(i, j, k)] = cubic(Index3{i, j, k}[axis]);
    flow::slopes(layout, layout.owned(), axis, false, u.first(), slope.first());
    const flow::CellRange owned = layout.owned();
    for (int k = 0; k < owned.upper.k; ++k) {
      const Index3 cell{3, 3, k};
      const double x = cell[axis];
      EXPECT_NEAR(slope.first()[layout.offset(3, 3, k)], 3 + x - 0.75 * x * x, 1e-12 * (3 + x * x));
    }
  }
}

TEST(Slopes, AreZeroAtExtremaAndNeverOvershootNeighboursWhenLimited) {
  const grid::Grid grid(world(), testing::cube(16, Boundary::Periodic));
  const flow::BlockLayout layout(grid);
  flow::BlockArray u(layout), slope(layout);
  Random random(7);
  const std::ptrdiff_t first = layout.offset(-flow::margin, 0, 0),
                       last = layout.offset(16 + flow::margin, 0, 0);
  for (std::ptrdiff_t c = first; c < last; ++c) u.first()[c] = random.uniform(-1, 1);
  flow::slopes(layout, {{0, 0, 0}, {16, 1, 1}}, 0, true, u.first(), slope.first());
  for (int i = 0; i < 16; ++i) {
    const double below = u.first()[i] - u.first()[i - 1], above = u.first()[i + 1] - u.first()[i];
    if (below * above <= 0) {
      EXPECT_EQ(slope.first()[i], 0.0);
    } else {
      EXPECT_GT(slope.first()[i] * below, 0.0);
      EXPECT_LE(std::abs(slope.first()[i]), 2 * std::min(std::abs(below), std::abs(above)));
    }
  }
}

/// Predicted and projected face velocities of a smooth random flow.
struct Predicted {
  explicit Predicted(const grid::Box& box,
                     grid::EllipticBackend backend = grid::EllipticBackend::Trigonometric)
      : grid(world(), box),
        u(grid),
        godunov(grid, true),
        elliptic(grid, backend),
        projection(grid, elliptic) {
    testing::set_velocity(u, testing::smooth_field(box, 1.0, 3));
    godunov.predict_normals(flow::ghosted_vector(u), flow::block_vector(flow::BlockLayout(grid)), 2.0,
                            0.2 * grid.h());
    projection.clear_divergence(godunov.face_velocity());
  }
  grid::Grid grid;
  grid::VectorField u;
  flow::Godunov godunov;
  grid::EllipticSolver elliptic;
  flow::Projection projection;
};

TEST(Godunov, LeavesNoDivergenceInAnyCellAfterTheMacProjection) {
  for (const Boundary boundary : {Boundary::Periodic, Boundary::Wall, Boundary::Slip}) {
    Predicted flow(testing::cube(16, boundary));
    // Velocities of order one differ across a cell by round-off of the transforms, some 1e-14, over h.
    EXPECT_LT(flow::max_divergence(flow.grid, flow.godunov.face_velocity()), 1e-12 / flow.grid.h());
  }
}

TEST(Godunov, NothingCrossesAWall) {
  for (const Boundary boundary : {Boundary::Wall, Boundary::Slip}) {
    Predicted flow(testing::cube(16, {boundary, Boundary::Periodic, boundary}));
    const flow::BlockLayout layout(flow.grid);
    const int nz = layout.owned().upper.k;
    double inside = 0;
    for (int k = 0; k < nz; ++k)
      for (int j = 0; j < 16; ++j) {
        EXPECT_EQ(flow.godunov.face_velocity()[0].first()[layout.offset(0, j, k)], 0.0);
        EXPECT_EQ(flow.godunov.face_velocity()[0].first()[layout.offset(16, j, k)], 0.0);
        inside = std::max(inside, std::abs(flow.godunov.face_velocity()[0].first()[layout.offset(8, j, k)]));
      }
    const double* z = flow.godunov.face_velocity()[2].first();
    for (int j = 0; j < 16; ++j)
      for (int i = 0; i < 16; ++i) {
        const double lowest = flow.grid.z_begin() == 0 ? z[layout.offset(i, j, 0)] : 0.0;
        const double highest = flow.grid.z_end() == 16 ? z[layout.offset(i, j, nz)] : 0.0;
        EXPECT_EQ(lowest, 0.0);
        EXPECT_EQ(highest, 0.0);
      }
    EXPECT_GT(inside, 0.01);
  }
}

TEST(Godunov, AdvectionConservesMomentumInAPeriodicBox) {
  Predicted flow(testing::cube(16, Boundary::Periodic));
  grid::VectorField advection(flow.grid);
  flow.godunov.advect(flow::ghosted_vector(flow.u), flow::block_vector(flow::BlockLayout(flow.grid)),
                      0.2 * flow.grid.h(), advection);
  for (int c = 0; c < 3; ++c) {
    const double largest = max_abs(advection[c]);
    EXPECT_GT(largest, 1.0);
    EXPECT_NEAR(sum(advection[c]), 0.0, 1e-13 * largest * static_cast<double>(flow.grid.total_size()));
  }
}

}  // namespace
}  // namespace spume
