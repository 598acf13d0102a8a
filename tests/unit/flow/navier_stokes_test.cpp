#include "spume/flow/navier_stokes.hpp"

#include <gtest/gtest.h>

#include <limits>

#include "spume/flow/wide_mean.hpp"
#include "spume/grid/spectral_filter.hpp"
#include "tests/unit/flow/smooth_flow.hpp"
#include "tests/unit/flow/whole_flow.hpp"

namespace spume {
namespace {

using grid::Boundary;

const state::Gas gas;
constexpr double speed = 0.3;  // [m/s]

TEST(NavierStokes, GivesTheSameStepWithBothEllipticBackends) {
  for (const Boundary boundary : {Boundary::Periodic, Boundary::Wall, Boundary::Slip}) {
    const grid::Box box = testing::cube(16, boundary);
    const auto world = parallel::Communicator::world();
    const auto exact =
        testing::after_steps(world, box, 2, {.elliptic = grid::EllipticBackend::Trigonometric});
    const auto iterated = testing::after_steps(world, box, 2, {.elliptic = grid::EllipticBackend::Multigrid});
    for (int c = 0; c < 3; ++c)
      EXPECT_LT(testing::largest_difference(exact[c], iterated[c]), 1e-8 * testing::flow_speed);
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
  EXPECT_LT(testing::velocity_error(gas_flow.velocity,
                                    [=](const Vec3&) {
                                      return Vec3{0, expected, 0};
                                    }),
            1e-13 * expected);
}

TEST(NavierStokes, AGradientForceIsBalancedByPressureAlone) {
  // A closed box full of gas at rest under a force that has a potential: the flow must die away as the
  // pressure settles.
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

/// Of a vector field: its divergence by wide differences times h, root mean square over that of the field,
/// and the part of Σ|u|² with a phase advance over 0.85 π a cell along some direction.
struct Roughness {
  double divergence, shortest_waves;
};
Roughness roughness_of(const grid::VectorField& u) {
  const grid::Grid& grid = u[0].grid();
  const grid::Ghosted<2> x(u[0]), y(u[1]), z(u[2]);
  double divergence = 0, shortest = 0, all = 0;
  for_each_cell(grid, [&](int i, int j, int k) {
    const auto along = [](auto&& at) { return flow::wide_difference(at(-2), at(-1), at(1), at(2)); };
    divergence += std::pow(along([&](int d) { return x(i + d, j, k); }) + along([&](int d) {
                             return y(i, j + d, k);
                           }) + along([&](int d) { return z(i, j, k + d); }),
                           2);
  });
  const auto is_short = [](const Vec3& theta) {
    return std::max({theta.x, theta.y, theta.z}) > 0.85 * std::numbers::pi ? 1.0 : 0.0;
  };
  for (int c = 0; c < 3; ++c) {
    grid::Field part(grid, u[c].symmetry());
    grid::SpectralFilter(grid, u[c].symmetry(), is_short).apply(u[c], part);
    for (const double value : part.values()) shortest += value * value;
    for (const double value : u[c].values()) all += value * value;
  }
  all = grid.communicator().sum(all);
  return {std::sqrt(grid.communicator().sum(divergence) / all), grid.communicator().sum(shortest) / all};
}

TEST(NavierStokes, NeitherDivergenceNorCellToCellWavesPileUpUnderASteadyForce) {
  for (const Boundary boundary : {Boundary::Periodic, Boundary::Wall}) {
    const grid::Box box = testing::cube(16, boundary);
    const grid::Grid grid(parallel::Communicator::world(), box);
    state::GasFlow gas_flow(grid);
    grid::VectorField force(grid);
    testing::set_velocity(force, testing::smooth_field(box, 20.0, 2));
    flow::NavierStokes navier_stokes(grid, gas, {});
    const auto advance = [&](int steps) {
      for (int step = 0; step < steps; ++step)
        navier_stokes.step(gas_flow, force, std::min(4e-4, navier_stokes.advection_limit(gas_flow, 0.4).dt));
      return roughness_of(gas_flow.velocity);
    };
    const Roughness early = advance(100), late = advance(400);
    EXPECT_LT(late.divergence, 1.5 * early.divergence);
    EXPECT_LT(late.divergence, 5e-3);
    EXPECT_LT(late.shortest_waves, 1.5 * early.shortest_waves);
    EXPECT_LT(late.shortest_waves, 1e-3);
  }
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
  state::Materials materials;
  materials.gas.density = 1.2;
  materials.film.surface_tension = 0.03;
  // sqrt(1.2 · 1e-12 / 0.06) = sqrt(2e-11)
  EXPECT_NEAR(flow::capillary_limit(1e-4, materials).dt, 0.8 * std::sqrt(2e-11), 1e-18);
  EXPECT_EQ(flow::capillary_limit(1e-4, materials).reason, "capillary waves");
}

}  // namespace
}  // namespace spume
