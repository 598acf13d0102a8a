#include <gtest/gtest.h>

#include "spume/flow/navier_stokes.hpp"
#include "tests/unit/flow/smooth_flow.hpp"

namespace spume {
namespace {

using grid::Boundary;
using std::numbers::pi;

/// Two no-slip walls across `axis`, `cells` apart; the other directions are periodic.
grid::Box channel(int axis, int cells) {
  grid::Box box{
      {0, 0, 0}, {0, 0, 0}, {8, 8, 8}, {Boundary::Periodic, Boundary::Periodic, Boundary::Periodic}};
  box.cells[axis] = cells;
  box.boundary[axis] = Boundary::Wall;
  const double h = testing::box_length / cells;
  box.upper = {h * box.cells.i, h * box.cells.j, h * box.cells.k};
  return box;
}

TEST(Walls, FlowBetweenNoSlipWallsDrivenByAForceSettlesToThePoiseuilleParabola) {
  const state::Gas gas;
  for (int axis = 0; axis < 3; ++axis) {
    const grid::Grid grid(parallel::Communicator::world(), channel(axis, 16));
    const int along = (axis + 1) % 3;
    const double width = testing::box_length, force = 0.01;  // [N/m³]
    state::GasFlow gas_flow(grid);
    grid::VectorField body_force(grid);
    body_force[along].fill(force);
    flow::NavierStokes navier_stokes(grid, gas, {});
    const double settling = gas.density * width * width / (pi * pi * gas.viscosity);
    for (int step = 0; step < 200; ++step) navier_stokes.step(gas_flow, body_force, 0.2 * settling);
    // The seven-point Laplacian is exact on the parabola; reflecting cell values about the wall shifts it by
    // fh²/(8μ).
    const double h = grid.h();
    const auto parabola = [&](const Vec3& x) {
      Vec3 u;
      u[along] = force / (2 * gas.viscosity) * (x[axis] * (width - x[axis]) + 0.25 * h * h);
      return u;
    };
    const double peak = force * width * width / (8 * gas.viscosity);
    EXPECT_LT(testing::velocity_error(gas_flow.velocity, parabola), 1e-10 * peak) << "axis " << axis;
  }
}

TEST(Walls, AShearFlowBetweenNoSlipWallsDecaysWithSecondOrderAccuracy) {
  const state::Gas gas;
  const double k = pi / testing::box_length;
  const double rate = gas.viscosity / gas.density * k * k;
  std::vector<double> errors;
  for (const int n : {16, 32}) {
    const grid::Grid grid(parallel::Communicator::world(), channel(2, n));
    const auto exact = [&](double t) {
      return [=](const Vec3& x) { return Vec3{0.1 * std::exp(-rate * t) * std::sin(k * x.z), 0, 0}; };
    };
    state::GasFlow gas_flow(grid);
    testing::set_velocity(gas_flow.velocity, exact(0));
    const grid::VectorField no_force(grid);
    flow::NavierStokes navier_stokes(grid, gas, {});
    for (int step = 0; step < n; ++step) navier_stokes.step(gas_flow, no_force, 1 / (rate * n));
    errors.push_back(testing::velocity_error(gas_flow.velocity, exact(1 / rate)) / 0.1);
  }
  EXPECT_LT(errors[1], 1e-3);
  EXPECT_NEAR(std::log2(errors[0] / errors[1]), 2.0, 0.1);
}

TEST(Walls, CrankNicolsonIsOfSecondOrderInTheStepAlone) {
  const state::Gas gas;
  const grid::Grid grid(parallel::Communicator::world(), channel(2, 16));
  // sin kz between the walls is a mode of the seven-point Laplacian, which decays at this rate on this grid.
  const double k = pi / testing::box_length;
  const double rate = gas.viscosity / gas.density * std::pow(2 * std::sin(0.5 * k * grid.h()) / grid.h(), 2);
  const auto exact = [&](double t) {
    return [=](const Vec3& x) { return Vec3{0.1 * std::exp(-rate * t) * std::sin(k * x.z), 0, 0}; };
  };
  std::vector<double> errors;
  for (const int steps : {4, 8, 16}) {
    state::GasFlow gas_flow(grid);
    testing::set_velocity(gas_flow.velocity, exact(0));
    const grid::VectorField no_force(grid);
    flow::NavierStokes navier_stokes(grid, gas, {});
    for (int step = 0; step < steps; ++step) navier_stokes.step(gas_flow, no_force, 1 / (rate * steps));
    errors.push_back(testing::velocity_error(gas_flow.velocity, exact(1 / rate)) / 0.1);
  }
  EXPECT_NEAR(std::log2(errors[0] / errors[1]), 2.0, 0.1);
  EXPECT_NEAR(std::log2(errors[1] / errors[2]), 2.0, 0.1);
}

TEST(Walls, AFlowLeftAloneBetweenWallsLosesKineticEnergyAtEveryStep) {
  const state::Gas gas;
  for (const Boundary boundary : {Boundary::Wall, Boundary::Slip}) {
    const grid::Box box = testing::cube(16, boundary);
    const grid::Grid grid(parallel::Communicator::world(), box);
    state::GasFlow gas_flow(grid);
    testing::set_velocity(gas_flow.velocity, testing::smooth_field(box, 0.3, 11));
    const grid::VectorField no_force(grid);
    flow::NavierStokes navier_stokes(grid, gas, {});
    double energy = flow::kinetic_energy(gas_flow, gas.density);
    const double start = energy;
    const double dt = navier_stokes.advection_limit(gas_flow, 0.4).dt;
    for (int step = 0; step < 50; ++step) {
      navier_stokes.step(gas_flow, no_force, dt);
      const double now = flow::kinetic_energy(gas_flow, gas.density);
      EXPECT_LT(now, energy) << "step " << step;
      energy = now;
    }
    EXPECT_GT(energy, 1e-3 * start);
  }
}

/// Velocities of an eddy between no-slip walls across x and y after a fixed time, cells × cells × 4.
std::vector<double> eddy(int cells, std::vector<double>& other_component) {
  const state::Gas gas{.density = 1.2, .viscosity = 1e-4};
  const double length = testing::box_length, k = pi / length, speed = 0.3;
  const grid::Box box{{0, 0, 0},
                      {length, length, 4 * length / cells},
                      {cells, cells, 4},
                      {Boundary::Wall, Boundary::Wall, Boundary::Periodic}};
  const grid::Grid grid(parallel::Communicator(MPI_COMM_SELF), box);
  state::GasFlow gas_flow(grid);
  // The stream function (speed/k) sin² kx sin² ky (1 + ½ cos kx): an eddy off the middle.
  testing::set_velocity(gas_flow.velocity, [=](const Vec3& x) {
    const double sx = std::sin(k * x.x), cx = std::cos(k * x.x), sy = std::sin(k * x.y),
                 cy = std::cos(k * x.y);
    return Vec3{speed * sx * sx * (1 + 0.5 * cx) * 2 * sy * cy,
                -speed * sy * sy * (2 * sx * cx * (1 + 0.5 * cx) - 0.5 * sx * sx * sx), 0};
  });
  const grid::VectorField no_force(grid);
  flow::NavierStokes navier_stokes(grid, gas, {.limit_slopes = false});
  const int steps = cells;
  for (int step = 0; step < steps; ++step)
    navier_stokes.step(gas_flow, no_force, 0.25 * length / speed / steps);
  other_component = gather(gas_flow.velocity[1]);
  return gather(gas_flow.velocity[0]);
}

/// Root mean square difference between a plane of 2n × 2n cells, averaged by fours, and one of n × n.
double difference(const std::vector<double>& fine, const std::vector<double>& coarse, int n) {
  double squares = 0;
  for (int j = 0; j < n; ++j)
    for (int i = 0; i < n; ++i) {
      const int corner = 2 * j * 2 * n + 2 * i;
      const double mean =
          0.25 * (fine[corner] + fine[corner + 1] + fine[corner + 2 * n] + fine[corner + 2 * n + 1]);
      squares += std::pow(mean - coarse[j * n + i], 2);
    }
  return std::sqrt(squares / (n * n));
}

TEST(Walls, AnEddyBetweenNoSlipWallsConvergesWithSecondOrder) {
  std::vector<std::vector<double>> u(3), v(3);
  for (int level = 0; level < 3; ++level) u[level] = eddy(16 << level, v[level]);
  const double order_u = std::log2(difference(u[1], u[0], 16) / difference(u[2], u[1], 32));
  const double order_v = std::log2(difference(v[1], v[0], 16) / difference(v[2], v[1], 32));
  EXPECT_NEAR(order_u, 2.0, 0.3);
  EXPECT_NEAR(order_v, 2.0, 0.3);
}

}  // namespace
}  // namespace spume
