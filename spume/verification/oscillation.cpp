#include "spume/verification/oscillation.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <span>
#include <vector>

#include "spume/verification/bubble_wave.hpp"
#include "spume/verification/foam_run.hpp"
#include "spume/verification/modes.hpp"

namespace spume::verification {

namespace {

using std::numbers::pi;

/// Largest rise from the mean over one period to that over the next, over the fall from the first to the
/// last; 0 where there are less than two whole periods. Means, because the film is known at whole steps and
/// the gas at half steps: within a period their sum wavers.
double growth_of(std::span<const double> time, std::span<const double> energy, double period) {
  const int n_periods = static_cast<int>(time.back() / period + 1e-9);
  std::vector<double> sum(n_periods, 0.0), count(n_periods, 0.0);
  for (std::size_t i = 0; i < time.size(); ++i) {
    const int m = static_cast<int>(time[i] / period);
    if (m >= n_periods) break;
    sum[m] += energy[i];
    ++count[m];
  }
  if (n_periods < 2) return 0;
  double rise = 0;
  const double fall = sum[0] / count[0] - sum[n_periods - 1] / count[n_periods - 1];
  for (int m = 1; m < n_periods; ++m) rise = std::max(rise, sum[m] / count[m] - sum[m - 1] / count[m - 1]);
  return fall > 0 ? rise / fall : std::numeric_limits<double>::infinity();
}

}  // namespace

double stokes_layer_cells(const OscillationSetting& setting) {
  const Decay exact = bubble_mode(setting.mode, 1, {1, setting.viscosity, 1});
  return std::sqrt(2 * setting.viscosity / exact.omega) * setting.cells_per_radius;
}

Decay fit_exact(const OscillationSetting& setting) {
  constexpr int n_samples = 400;
  const WaveMaterials materials{1, setting.viscosity, 1};
  const Decay mode = bubble_mode(setting.mode, 1, materials);
  const BubbleWave wave(setting.mode, 1, materials);
  const double period = 2 * pi / mode.omega;
  std::vector<double> time, value;
  for (int i = 0; i <= n_samples; ++i) {
    time.push_back(period * (1 + (setting.periods - 1) * i / n_samples));
    value.push_back(wave.amplitude(time.back()));
  }
  return fit_damped_cosine(time, value, mode);
}

Oscillation oscillate(const parallel::Communicator& communicator, const OscillationSetting& setting) {
  const int n = setting.mode, cells = setting.cells_per_radius;
  const Units units = units_of_viscosity(setting.viscosity);
  const double radius = units.radius;
  auto run_case = cube_case(units, setting.box_radii * cells, cells);
  if (setting.reconstruct_every > 0) run_case.rearrangement.reconstruction_interval = 1000000;
  FoamRun run(communicator, run_case, 1, [&](mesh::Phase phase, const Vec3& x) {
    const double r = norm(x), cosine = r > 0 ? x.z / r : 1;
    const double outwards = r - radius * (1 + setting.amplitude * std::legendre(n, cosine));
    return phase == 0 ? 0.5 * outwards : -0.5 * outwards;
  });
  const Decay exact = bubble_mode(n, 1, {1, setting.viscosity, 1});
  const double period = 2 * pi / exact.omega;
  std::vector<double> time, value, energy;
  Oscillation result{};
  run.move_until(setting.periods * period * units.time(), [&](const simulation::MotionStep& step) {
    energy.push_back(step.kinetic_energy + units.tension * step.film_area);
    time.push_back(run.foam().time / units.time());
    value.push_back(mode_amplitude(run.foam().films, 1, n) / radius);
    result.n_reconstructions += step.reconstructed;
    if (setting.reconstruct_every > 0 && time.size() % setting.reconstruct_every == 0) {
      run.reconstruct();
      ++result.n_reconstructions;
    }
    return true;
  });
  std::size_t first = 0;
  while (time[first] < period) ++first;
  result.fit = fit_damped_cosine(std::span(time).subspan(first), std::span(value).subspan(first), exact);
  result.growth = growth_of(time, energy, period);
  return result;
}

}  // namespace spume::verification
