#include <fmt/format.h>

#include <cmath>
#include <vector>

#include "spume/mesh/measure.hpp"
#include "spume/verification/foam_run.hpp"
#include "spume/verification/modes.hpp"
#include "spume/verification/tables.hpp"

namespace spume::verification {

namespace {

struct Oscillation {
  Decay fit;  ///< in units of the capillary time
  double
      energy_growth;  ///< largest rise of film and kinetic energy above an earlier value, of the wave's own
};

/// A bubble of unit radius with mode n of relative amplitude 0.02 in a box four radii wide, for `periods`.
Oscillation oscillate(const parallel::Communicator& communicator, int n, double viscosity,
                      int cells_per_radius, double periods) {
  constexpr double amplitude = 0.02;
  const Units units = units_of_viscosity(viscosity);
  const double radius = units.radius;
  FoamRun run(communicator, cube_case(units, 4 * cells_per_radius, cells_per_radius), 1,
              [&](mesh::Phase phase, const Vec3& x) {
                const double r = norm(x), cosine = r > 0 ? x.z / r : 1;
                const double outwards = r - radius * (1 + amplitude * std::legendre(n, cosine));
                return phase == 0 ? 0.5 * outwards : -0.5 * outwards;
              });
  const Decay exact = bubble_mode(n, 1, {1, viscosity, 1});
  std::vector<double> time, value;
  double least_energy = 1e300, first_energy = 0, growth = 0;
  const double rest_area =
      4 * std::numbers::pi *
      std::pow(3 / (4 * std::numbers::pi) * mesh::phase_volumes(run.foam().films, 2)[1], 2.0 / 3);
  run.move_until(periods * 2 * std::numbers::pi / exact.omega * units.time(),
                 [&](const simulation::MotionStep& step) {
                   time.push_back(run.foam().time / units.time());
                   value.push_back(mode_amplitude(run.foam().films, 1, n) / radius);
                   const double energy = step.kinetic_energy + units.tension * (step.film_area - rest_area);
                   if (time.size() == 1) first_energy = energy;
                   growth = std::max(growth, (energy - least_energy) / first_energy);
                   least_energy = std::min(least_energy, energy);
                   return true;
                 });
  // The first quarter of a period has the transient of the layer around the film.
  std::size_t first = 0;
  while (time[first] < 0.25 * 2 * std::numbers::pi / exact.omega) ++first;
  return {fit_damped_cosine(std::span(time).subspan(first), std::span(value).subspan(first), exact), growth};
}

}  // namespace

void oscillating_bubble(const parallel::Communicator& communicator, Scale scale, Report& report) {
  report.note("ρ = 2σ = R = 1, box 4 R wide; frequency ω and damping γ of modes by a fit over two periods");
  struct Setting {
    double viscosity;
    std::vector<int> modes, radii;
  };
  const std::vector<Setting> settings =
      scale == Scale::Full
          ? std::vector<Setting>{{0.05, {2, 3, 4}, {8, 16}}, {0.01, {2, 3, 4}, {16}}, {0.001, {2}, {16}}}
          : std::vector<Setting>{{0.05, {2}, {6, 8}}};
  for (const auto& [viscosity, modes, radii] : settings)
    for (const int n : modes) {
      const Decay exact = bubble_mode(n, 1, {1, viscosity, 1});
      for (const int cells_per_radius : radii) {
        const double layer_cells = std::sqrt(2 * viscosity / exact.omega) * cells_per_radius;
        const Oscillation got = oscillate(communicator, n, viscosity, cells_per_radius, 2);
        const std::string what = fmt::format("mode {}, μ = {}, R = {} h", n, viscosity, cells_per_radius);
        report.note(fmt::format("{}: Stokes layer of {:.1f} cells", what, layer_cells));
        if (layer_cells >= 3) {
          report.relative(what + ": ω", got.fit.omega, exact.omega, 0.01, "exact viscous law");
          report.relative(what + ": γ", got.fit.gamma, exact.gamma, 0.04, "exact viscous law");
        } else {
          report.told(what + ": ω", got.fit.omega, "exact viscous law", exact.omega);
          report.told(what + ": γ", got.fit.gamma, "exact viscous law", exact.gamma);
        }
      }
    }
}

}  // namespace spume::verification
