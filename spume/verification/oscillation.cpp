#include "spume/verification/oscillation.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <span>
#include <vector>

#include "spume/mesh/measure.hpp"
#include "spume/verification/foam_run.hpp"
#include "spume/verification/modes.hpp"

namespace spume::verification {

namespace {

using std::numbers::pi;

/// Rises of an energy above its least value so far.
struct Growth {
  double first = 0, least = 0, largest = 0;

  void add(double energy, bool is_first) {
    if (is_first) first = least = energy;
    largest = std::max(largest, (energy - least) / first);
    least = std::min(least, energy);
  }
};

}  // namespace

double stokes_layer_cells(const OscillationSetting& setting) {
  const Decay exact = bubble_mode(setting.mode, 1, {1, setting.viscosity, 1});
  return std::sqrt(2 * setting.viscosity / exact.omega) * setting.cells_per_radius;
}

Oscillation oscillate(const parallel::Communicator& communicator, const OscillationSetting& setting) {
  constexpr double amplitude = 0.02;
  const int n = setting.mode, cells = setting.cells_per_radius;
  const Units units = units_of_viscosity(setting.viscosity);
  const double radius = units.radius;
  auto run_case = cube_case(units, setting.box_radii * cells, cells);
  if (setting.reconstruct_every > 0) run_case.rearrangement.reconstruction_interval = 1000000;
  FoamRun run(communicator, run_case, 1, [&](mesh::Phase phase, const Vec3& x) {
    const double r = norm(x), cosine = r > 0 ? x.z / r : 1;
    const double outwards = r - radius * (1 + amplitude * std::legendre(n, cosine));
    return phase == 0 ? 0.5 * outwards : -0.5 * outwards;
  });
  const Decay exact = bubble_mode(n, 1, {1, setting.viscosity, 1});
  const double volume = mesh::phase_volumes(run.foam().films, 2)[1];
  const double rest_area = 4 * pi * std::pow(3 * volume / (4 * pi), 2.0 / 3);
  std::vector<double> time, value;
  Growth growth;
  Oscillation result{};
  run.move_until(
      setting.periods * 2 * pi / exact.omega * units.time(), [&](const simulation::MotionStep& step) {
        growth.add(step.kinetic_energy + units.tension * (step.film_area - rest_area), time.empty());
        time.push_back(run.foam().time / units.time());
        value.push_back(mode_amplitude(run.foam().films, 1, n) / radius);
        result.n_reconstructions += step.reconstructed;
        if (setting.reconstruct_every > 0 && time.size() % setting.reconstruct_every == 0) {
          run.reconstruct();
          ++result.n_reconstructions;
        }
        return true;
      });
  std::size_t first = 0;  // a period on, the layer around the film has formed
  while (time[first] < 2 * pi / exact.omega) ++first;
  result.fit = fit_damped_cosine(std::span(time).subspan(first), std::span(value).subspan(first), exact);
  result.growth = growth.largest;
  return result;
}

}  // namespace spume::verification
