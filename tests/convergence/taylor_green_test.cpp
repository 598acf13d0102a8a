#include <gtest/gtest.h>

#include <vector>

#include "spume/flow/navier_stokes.hpp"
#include "tests/support/exact_flows.hpp"

namespace spume {
namespace {

using grid::Boundary;

constexpr double length = 0.02;  // of the periods [m]
constexpr double speed = 0.3;    // of the vortices [m/s]
const double wave_number = 2 * std::numbers::pi / length;

/// A gas in which the vortices have the Reynolds number U/(νk).
state::Gas gas_of(double reynolds) {
  return {.density = 1.2, .viscosity = 1.2 * speed / (reynolds * wave_number)};
}
double nu_of(const state::Gas& gas) {
  return gas.viscosity / gas.density;
}
const Vec3 mean{0.9 * speed, -0.6 * speed, 0.4 * speed};

/// A box `length` wide, with as many cells; across `thin` (unless −1) only four.
grid::Box box_of(int cells, int thin, Boundary boundary = Boundary::Periodic) {
  grid::Box box{{0, 0, 0}, {length, length, length}, {cells, cells, cells}, {boundary, boundary, boundary}};
  if (thin >= 0) {
    box.cells[thin] = 4;
    box.upper[thin] = length * 4 / cells;
    box.boundary[thin] = Boundary::Periodic;
  }
  return box;
}

struct Errors {
  double velocity, pressure;
};

/// Relative errors of an exact flow after `end_time` in `steps` steps.
Errors errors_of(const testing::ExactFlow& exact, const state::Gas& gas, const grid::Box& box,
                 double end_time, int steps,
                 const flow::FlowParameters& parameters = {.limit_slopes = false}) {
  const grid::Grid grid(parallel::Communicator::world(), box);
  state::GasFlow gas_flow(grid);
  testing::set_velocity(gas_flow.velocity, [&](const Vec3& x) { return exact.velocity(x, 0); });
  const grid::VectorField no_force(grid);
  flow::NavierStokes navier_stokes(grid, gas, parameters);
  const double dt = end_time / steps;
  for (int step = 0; step < steps; ++step) navier_stokes.step(gas_flow, no_force, dt);
  return {
      testing::velocity_error(gas_flow.velocity, [&](const Vec3& x) { return exact.velocity(x, end_time); }) /
          speed,
      testing::scalar_error(gas_flow.pressure, [&](const Vec3& x) {
        return exact.pressure(x, end_time - 0.5 * dt);
      }) / (gas.density * speed * speed)};
}

double order(double coarse, double fine) {
  return std::log2(coarse / fine);
}

struct Orders {
  double velocity_coarse, velocity, pressure;
};

/// Halves h and Δt together from 16 to 64 cells across; prints and gives the orders of convergence.
Orders orders_of(const char* name, const testing::ExactFlow& exact, const state::Gas& gas, int thin,
                 Boundary boundary = Boundary::Periodic) {
  std::vector<Errors> errors;
  for (const int n : {16, 32, 64})
    errors.push_back(errors_of(exact, gas, box_of(n, thin, boundary), 0.12 * length / speed, n));
  const Orders orders{order(errors[0].velocity, errors[1].velocity),
                      order(errors[1].velocity, errors[2].velocity),
                      order(errors[1].pressure, errors[2].pressure)};
  std::printf("%-28s velocity %.2e %.2e %.2e, orders %.2f %.2f; pressure %.2e %.2e %.2e, order %.2f\n", name,
              errors[0].velocity, errors[1].velocity, errors[2].velocity, orders.velocity_coarse,
              orders.velocity, errors[0].pressure, errors[1].pressure, errors[2].pressure, orders.pressure);
  return orders;
}

TEST(TaylorGreen, VorticesCarriedAcrossThePeriodicBoxConvergeWithSecondOrderInEveryPlane) {
  const state::Gas gas = gas_of(30);
  const char* const names[] = {"vortices in the y-z plane", "vortices in the z-x plane",
                               "vortices in the x-y plane"};
  for (int axis = 0; axis < 3; ++axis) {
    const auto exact = testing::taylor_green(axis, wave_number, speed, nu_of(gas), gas.density, mean);
    const Orders orders = orders_of(names[axis], exact, gas, axis);
    EXPECT_NEAR(orders.velocity_coarse, 2.0, 0.25);
    EXPECT_NEAR(orders.velocity, 2.0, 0.25);
    EXPECT_NEAR(orders.pressure, 2.0, 0.25);
  }
}

TEST(TaylorGreen, ACarriedBeltramiFlowConvergesWithSecondOrderInThreeDimensions) {
  const state::Gas gas = gas_of(30);
  const auto exact = testing::beltrami(wave_number, speed, nu_of(gas), gas.density, mean);
  const Orders orders = orders_of("Beltrami flow", exact, gas, -1);
  EXPECT_NEAR(orders.velocity_coarse, 2.0, 0.25);
  EXPECT_NEAR(orders.velocity, 2.0, 0.25);
  EXPECT_NEAR(orders.pressure, 2.0, 0.25);
}

TEST(TaylorGreen, VorticesBetweenSlipWallsConvergeWithSecondOrder) {
  const auto orders_at = [](double reynolds, const char* name) {
    const state::Gas gas = gas_of(reynolds);
    const auto exact = testing::taylor_green(2, wave_number, speed, nu_of(gas), gas.density);
    return orders_of(name, exact, gas, 2, Boundary::Slip);
  };
  // Where vortices stand still, the second-order errors of advection are gradients, which the pressure takes:
  // the velocity of the fast ones converges with third order, and that of the slow ones shows the errors of
  // viscosity.
  const Orders slow = orders_at(0.5, "slow vortices, slip walls"),
               fast = orders_at(30, "fast vortices, slip walls");
  EXPECT_NEAR(slow.velocity_coarse, 2.0, 0.25);
  EXPECT_NEAR(slow.velocity, 2.0, 0.25);
  EXPECT_GT(fast.velocity, 2.75);
  EXPECT_NEAR(fast.pressure, 2.0, 0.25);
}

TEST(TaylorGreen, LimitedSlopesStillConvergeFasterThanFirstOrder) {
  const state::Gas gas = gas_of(30);
  const auto exact = testing::taylor_green(2, wave_number, speed, nu_of(gas), gas.density, mean);
  std::vector<Errors> errors;
  for (const int n : {32, 64})
    errors.push_back(errors_of(exact, gas, box_of(n, 2), 0.12 * length / speed, n, {.limit_slopes = true}));
  // At extrema the limiter gives up second order, in a part of the box that shrinks with h.
  EXPECT_GT(order(errors[0].velocity, errors[1].velocity), 1.5);
}

/// Relative difference between carried vortices after a fixed time in `steps` steps and in eight times as
/// many.
double error_of_the_step(int cells, int steps) {
  const state::Gas gas = gas_of(30);
  const auto exact = testing::taylor_green(2, wave_number, speed, nu_of(gas), gas.density, mean);
  const grid::Grid grid(parallel::Communicator::world(), box_of(cells, 2));
  const double end_time = 0.06 * length / speed;
  const grid::VectorField no_force(grid);
  const auto run = [&](int n_steps) {
    state::GasFlow gas_flow(grid);
    testing::set_velocity(gas_flow.velocity, [&](const Vec3& x) { return exact.velocity(x, 0); });
    flow::NavierStokes navier_stokes(grid, gas, {.limit_slopes = false});
    for (int step = 0; step < n_steps; ++step) navier_stokes.step(gas_flow, no_force, end_time / n_steps);
    return gas_flow;
  };
  const state::GasFlow coarse = run(steps), fine = run(8 * steps);
  double squares = 0;
  for (int c = 0; c < 3; ++c)
    for (std::size_t i = 0; i < grid.owned_size(); ++i)
      squares += std::pow(coarse.velocity[c].values()[i] - fine.velocity[c].values()[i], 2);
  return std::sqrt(grid.communicator().sum(squares) / static_cast<double>(grid.total_size())) / speed;
}

TEST(TaylorGreen, TheErrorOfTheStepFallsWithTheStepTimesTheCellSize) {
  // The predictor follows the flow for half a step from the centre of the upwind cell and not from the face,
  // which leaves an error of order h Δt: first order in either alone, second in both together.
  const double error = error_of_the_step(16, 32), half_step = error_of_the_step(16, 64),
               half_cells = error_of_the_step(32, 32), both = error_of_the_step(32, 64);
  std::printf("error of the step %.2e, orders %.2f in the step, %.2f in h, %.2f in both\n", error,
              order(error, half_step), order(error, half_cells), order(error, both));
  EXPECT_NEAR(order(error, half_step), 1.0, 0.25);
  EXPECT_NEAR(order(error, half_cells), 1.0, 0.25);
  EXPECT_NEAR(order(error, both), 2.0, 0.25);
}

}  // namespace
}  // namespace spume
