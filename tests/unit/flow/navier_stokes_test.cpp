#include "spume/flow/navier_stokes.hpp"

#include <gtest/gtest.h>
#include <mpi.h>

#include <limits>

#include "spume/base/error.hpp"
#include "spume/grid/spectral_filter.hpp"
#include "tests/unit/flow/smooth_flow.hpp"

namespace spume {
namespace {

using grid::Boundary;

const state::Gas gas;
constexpr double speed = 0.3;  // [m/s]

/// All cells of velocity and pressure after some steps from a smooth random flow under a smooth random force.
std::array<std::vector<double>, 4> after_steps(const parallel::Communicator& ranks, const grid::Box& box, int steps,
                                               const flow::FlowParameters& parameters) {
  const grid::Grid grid(ranks, box);
  state::GasFlow gas_flow(grid);
  testing::set_velocity(gas_flow.velocity, testing::smooth_field(box, speed, 1));
  grid::VectorField force(grid);
  testing::set_velocity(force, testing::smooth_field(box, 20.0, 2));
  flow::NavierStokes navier_stokes(grid, gas, parameters);
  for (int step = 0; step < steps; ++step) navier_stokes.step(gas_flow, force, 0.2 * grid.h() / speed);
  return {gather(gas_flow.velocity[0]), gather(gas_flow.velocity[1]), gather(gas_flow.velocity[2]),
          gather(gas_flow.pressure)};
}

double largest_difference(const std::vector<double>& a, const std::vector<double>& b) {
  double largest = 0;
  for (std::size_t i = 0; i < a.size(); ++i) largest = std::max(largest, std::abs(a[i] - b[i]));
  return largest;
}

TEST(NavierStokes, GivesTheSameFlowOnAnyNumberOfRanks) {
  for (const auto& boundary : {std::array{Boundary::Periodic, Boundary::Periodic, Boundary::Periodic},
                               std::array{Boundary::Slip, Boundary::Periodic, Boundary::Wall}}) {
    const grid::Box box = testing::cube(16, boundary);
    const auto together = after_steps(parallel::Communicator::world(), box, 5, {});
    const auto alone = after_steps(parallel::Communicator(MPI_COMM_SELF), box, 5, {});
    for (int c = 0; c < 3; ++c) EXPECT_LT(largest_difference(together[c], alone[c]), 1e-12 * speed);
    EXPECT_LT(largest_difference(together[3], alone[3]), 1e-12 * gas.density * speed * speed);
  }
}

TEST(NavierStokes, GivesTheSameStepWithBothEllipticBackends) {
  for (const Boundary boundary : {Boundary::Periodic, Boundary::Wall, Boundary::Slip}) {
    const grid::Box box = testing::cube(16, boundary);
    const auto world = parallel::Communicator::world();
    const auto exact = after_steps(world, box, 2, {.elliptic = grid::EllipticBackend::Trigonometric});
    const auto iterated = after_steps(world, box, 2, {.elliptic = grid::EllipticBackend::Multigrid});
    for (int c = 0; c < 3; ++c) EXPECT_LT(largest_difference(exact[c], iterated[c]), 1e-8 * speed);
  }
}

TEST(NavierStokes, KeepsTheMomentumOfAPeriodicBoxWithoutForce) {
  const grid::Box box = testing::cube(16, Boundary::Periodic);
  const grid::Grid grid(parallel::Communicator::world(), box);
  state::GasFlow gas_flow(grid);
  const auto swirl = testing::smooth_field(box, speed, 4);
  testing::set_velocity(gas_flow.velocity, [&](const Vec3& x) { return swirl(x) + Vec3{0.1, -0.2, 0.05}; });
  const Vec3 before{sum(gas_flow.velocity[0]), sum(gas_flow.velocity[1]), sum(gas_flow.velocity[2])};
  const grid::VectorField no_force(grid);
  flow::NavierStokes navier_stokes(grid, gas, {});
  for (int step = 0; step < 20; ++step)
    navier_stokes.step(gas_flow, no_force, navier_stokes.advection_limit(gas_flow, 0.4).dt);
  for (int c = 0; c < 3; ++c)
    EXPECT_NEAR(sum(gas_flow.velocity[c]), before[c], 1e-12 * speed * static_cast<double>(grid.total_size()));
}

TEST(NavierStokes, AUniformForceAcceleratesAPeriodicBoxUniformly) {
  const grid::Grid grid(parallel::Communicator::world(), testing::cube(16, Boundary::Periodic));
  state::GasFlow gas_flow(grid);
  grid::VectorField force(grid);
  force[1].fill(6.0);
  flow::NavierStokes navier_stokes(grid, gas, {});
  const double dt = 1e-3;
  for (int step = 0; step < 4; ++step) navier_stokes.step(gas_flow, force, dt);
  const double expected = 4 * dt * 6.0 / gas.density;
  EXPECT_LT(testing::velocity_error(gas_flow.velocity, [=](const Vec3&) { return Vec3{0, expected, 0}; }),
            1e-13 * expected);
}

TEST(NavierStokes, AGradientForceIsBalancedByPressureAlone) {
  // A closed box full of gas at rest under a force that has a potential: the flow must die away as the pressure settles.
  const grid::Box box = testing::cube(16, Boundary::Wall);
  const grid::Grid grid(parallel::Communicator::world(), box);
  const double k = std::numbers::pi / testing::box_length;
  state::GasFlow gas_flow(grid);
  grid::VectorField force(grid);
  testing::set_velocity(force, [=](const Vec3& x) {
    return Vec3{-std::sin(k * x.x) * std::cos(k * x.y), -std::cos(k * x.x) * std::sin(k * x.y), 0.0};
  });
  flow::NavierStokes navier_stokes(grid, gas, {});
  const double dt = 1e-4;
  for (int step = 0; step < 20; ++step) navier_stokes.step(gas_flow, force, dt);
  EXPECT_LT(testing::scalar_error(gas_flow.pressure,
                                  [=](const Vec3& x) { return std::cos(k * x.x) * std::cos(k * x.y) / k; }),
            0.01 / k);
  // Unopposed, the force would have given the gas 20 Δt f/ρ.
  EXPECT_LT(flow::max_speed(gas_flow), 0.01 * 20 * dt / gas.density);
}

TEST(NavierStokes, StepLimitsAreThoseOfAdvectionAndOfCapillaryWaves) {
  const grid::Grid grid(parallel::Communicator::world(), testing::cube(16, Boundary::Periodic));
  state::GasFlow gas_flow(grid);
  flow::NavierStokes navier_stokes(grid, gas, {});
  EXPECT_EQ(navier_stokes.advection_limit(gas_flow, 0.4).dt, std::numeric_limits<double>::infinity());
  gas_flow.velocity[0].fill(3);
  gas_flow.velocity[2].fill(-4);
  EXPECT_NEAR(flow::max_speed(gas_flow), 5.0, 1e-14);
  const flow::StepLimit advection = navier_stokes.advection_limit(gas_flow, 0.4);
  EXPECT_NEAR(advection.dt, 0.4 * grid.h() / 5, 1e-15 * grid.h());
  EXPECT_EQ(advection.reason, "advection");
  EXPECT_NEAR(flow::kinetic_energy(gas_flow, 2.0), 25 * std::pow(testing::box_length, 3), 1e-18);
  const state::Materials materials{.gas = {.density = 1.2}, .film = {.surface_tension = 0.03}};
  // sqrt(1.2 · 1e-12 / 0.06) = sqrt(2e-11)
  EXPECT_NEAR(flow::capillary_limit(1e-4, materials).dt, 0.8 * std::sqrt(2e-11), 1e-18);
  EXPECT_EQ(flow::capillary_limit(1e-4, materials).reason, "capillary waves");
}

TEST(NavierStokes, AStepThatIsNotFiniteIsANumericalError) {
  const grid::Grid grid(parallel::Communicator::world(), testing::cube(16, Boundary::Periodic));
  state::GasFlow gas_flow(grid);
  grid::VectorField force(grid);
  if (grid.communicator().is_root()) force[0].values()[5] = std::numeric_limits<double>::quiet_NaN();
  flow::NavierStokes navier_stokes(grid, gas, {});
  EXPECT_THROW(navier_stokes.step(gas_flow, force, 1e-4), NumericalError);
}

}  // namespace
}  // namespace spume
