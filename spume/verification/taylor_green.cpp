#include <fmt/format.h>

#include <cmath>
#include <numbers>
#include <vector>

#include "spume/flow/navier_stokes.hpp"
#include "spume/verification/exact_flows.hpp"
#include "spume/verification/tables.hpp"

namespace spume::verification {

namespace {

constexpr double length = 0.02, speed = 0.3, density = 1.2;  // [m], [m/s], [kg/m³]
const double wave_number = 2 * std::numbers::pi / length;

/// Relative rms error of the velocity after 0.12 periods in `cells` steps. Across z there are four cells
/// where the flow is plane.
double error_of(const parallel::Communicator& communicator, const ExactFlow& exact, double viscosity,
                int cells, bool plane) {
  const int across = plane ? 4 : cells;
  const grid::Grid grid(communicator,
                        {{0, 0, 0}, {length, length, length * across / cells}, {cells, cells, across}});
  state::GasFlow flow(grid);
  set_velocity(flow.velocity, [&](const Vec3& x) { return exact.velocity(x, 0); });
  const grid::VectorField no_force(grid);
  flow::NavierStokes gas(grid, {.density = density, .viscosity = viscosity}, {.limit_slopes = false});
  const double end = 0.12 * length / speed;
  for (int step = 0; step < cells; ++step) gas.step(flow, no_force, end / cells);
  return velocity_error(flow.velocity, [&](const Vec3& x) { return exact.velocity(x, end); }) / speed;
}

}  // namespace

void taylor_green(const parallel::Communicator& communicator, Scale scale, Report& report) {
  report.note("vortices at Reynolds number 30, carried across a periodic box, Δt in proportion to h");
  const double nu = speed / (30 * wave_number);
  const Vec3 mean{0.9 * speed, -0.6 * speed, 0.4 * speed};
  const std::vector<int> grids =
      scale == Scale::Full ? std::vector<int>{16, 32, 64} : std::vector<int>{16, 32};
  for (const bool plane : {true, false}) {
    const ExactFlow exact = plane ? taylor_green(2, wave_number, speed, nu, density, mean)
                                  : beltrami(wave_number, speed, nu, density, mean);
    double coarser = 0;
    for (const int cells : grids) {
      const double error = error_of(communicator, exact, density * nu, cells, plane);
      const std::string what =
          fmt::format("{}, {} cells a period: ", plane ? "Taylor-Green" : "Beltrami", cells);
      report.told(what + "velocity error, relative", error, "closed form", 0.0);
      if (coarser > 0) report.absolute(what + "order", std::log2(coarser / error), 2, 0.25, "second order");
      coarser = error;
    }
  }
}

}  // namespace spume::verification
