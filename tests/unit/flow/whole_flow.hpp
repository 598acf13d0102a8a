#pragma once

#include <array>
#include <vector>

#include "spume/flow/navier_stokes.hpp"
#include "tests/unit/flow/smooth_flow.hpp"

namespace spume::testing {

inline constexpr double flow_speed = 0.3;  // [m/s]

/// All cells of velocity and pressure after some steps from a smooth random flow under a smooth random force.
inline std::array<std::vector<double>, 4> after_steps(const parallel::Communicator& ranks,
                                                      const grid::Box& box, int steps,
                                                      const flow::FlowParameters& parameters) {
  const grid::Grid grid(ranks, box);
  state::GasFlow gas_flow(grid);
  set_velocity(gas_flow.velocity, smooth_field(box, flow_speed, 1));
  grid::VectorField force(grid);
  set_velocity(force, smooth_field(box, 20.0, 2));
  flow::NavierStokes navier_stokes(grid, state::Gas{}, parameters);
  for (int step = 0; step < steps; ++step) navier_stokes.step(gas_flow, force, 0.2 * grid.h() / flow_speed);
  return {gather(gas_flow.velocity[0]), gather(gas_flow.velocity[1]), gather(gas_flow.velocity[2]),
          gather(gas_flow.pressure)};
}

inline double largest_difference(const std::vector<double>& a, const std::vector<double>& b) {
  double largest = 0;
  for (std::size_t i = 0; i < a.size(); ++i) largest = std::max(largest, std::abs(a[i] - b[i]));
  return largest;
}

}  // namespace spume::testing
