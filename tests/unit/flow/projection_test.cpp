#include "spume/flow/projection.hpp"

#include <gtest/gtest.h>

#include "tests/unit/flow/smooth_flow.hpp"

namespace spume {
namespace {

using grid::Boundary;
using std::numbers::pi;

/// Largest velocity left of G q by the projection, over the largest of G q, for q a product of cosines.
double left_of_a_gradient(int cells, Boundary boundary) {
  const grid::Grid grid(parallel::Communicator::world(), testing::cube(cells, boundary));
  grid::EllipticSolver elliptic(grid, grid::EllipticBackend::Trigonometric);
  flow::Projection projection(grid, elliptic);
  const double k = 2 * pi / testing::box_length;
  grid::VectorField rate(grid);
  testing::set_velocity(rate, [=](const Vec3& x) {
    return Vec3{std::sin(k * x.x) * std::cos(k * x.y), std::cos(k * x.x) * std::sin(k * x.y), 0.0};
  });
  grid::Field pressure(grid);
  projection.project(1.2, rate, pressure);
  return std::max({max_abs(rate[0]), max_abs(rate[1]), max_abs(rate[2])});
}

TEST(Projection, RemovesAGradientToSecondOrder) {
  for (const Boundary boundary : {Boundary::Periodic, Boundary::Wall, Boundary::Slip}) {
    const double coarse = left_of_a_gradient(32, boundary), fine = left_of_a_gradient(64, boundary);
    EXPECT_LT(fine, 0.001);
    EXPECT_NEAR(std::log2(coarse / fine), 2.0, 0.1);
  }
}

TEST(Projection, GivesThePressureOfTheGradientItRemoves) {
  const grid::Grid grid(parallel::Communicator::world(), testing::cube(32, Boundary::Slip));
  grid::EllipticSolver elliptic(grid, grid::EllipticBackend::Trigonometric);
  flow::Projection projection(grid, elliptic);
  const double k = pi / testing::box_length;
  const double density = 1.2;
  grid::VectorField rate(grid);
  testing::set_velocity(rate, [=](const Vec3& x) { return Vec3{0, 0, std::sin(k * x.z)}; });
  grid::Field pressure(grid);
  pressure.fill(5);
  projection.project(density, rate, pressure);
  // x = −∇q/ρ with ∇q = −ρ sin kz: q = (ρ/k) cos kz has to be taken, so ψ = −q; the seven-point
  // Laplacian is off by (kh)²/12.
  const double kh = k * grid.h();
  EXPECT_LT(testing::scalar_error(pressure, [=](const Vec3& x) { return -density / k * std::cos(k * x.z); }),
            1.05 * kh * kh / 12 * density / k);
}

TEST(Projection, LeavesARotationAlone) {
  const grid::Grid grid(parallel::Communicator::world(), testing::cube(16, Boundary::Periodic));
  grid::EllipticSolver elliptic(grid, grid::EllipticBackend::Trigonometric);
  flow::Projection projection(grid, elliptic);
  const auto vortex = testing::beltrami(2 * pi / testing::box_length, 1.0, 0.0, 1.0);
  const auto velocity = [&](const Vec3& x) { return vortex.velocity(x, 0); };
  grid::VectorField rate(grid);
  testing::set_velocity(rate, velocity);
  grid::Field pressure(grid);
  projection.project(1.2, rate, pressure);
  // Its divergence is zero, each component being constant along its own direction.
  EXPECT_LT(testing::velocity_error(rate, velocity), 1e-13);
}

}  // namespace
}  // namespace spume
