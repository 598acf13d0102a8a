#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <span>
#include <vector>

#include "spume/mesh/measure.hpp"
#include "spume/verification/foam_run.hpp"
#include "spume/verification/modes.hpp"
#include "spume/verification/tables.hpp"

namespace spume::verification {

namespace {

/// Number of local maxima of a curve that stand out by `least` over the minima beside them.
int count_waves(std::span<const double> value, double least) {
  int n = 0;
  double low = value.front(), high = value.front();
  bool rising = false;
  for (double v : value) {
    if (!rising && v > low + least) rising = true, high = v;
    if (rising && v < high - least) rising = false, low = v, ++n;
    low = std::min(low, v);
    high = std::max(high, v);
  }
  return n;
}

}  // namespace

void fig12_area(const parallel::Communicator& communicator, Scale scale, Report& report) {
  report.note("seven bubbles of 10 mm in equilibrium lose a film; gas and films of the paper's Table 5");
  const int cells = scale == Scale::Full ? 64 : 40;
  simulation::Case run_case;
  run_case.box = {{-20e-3, -20e-3, -20e-3}, {20e-3, 20e-3, 20e-3}, {cells, cells, cells}};
  run_case.materials.gas = {.density = 1.15, .viscosity = 1.8e-5};
  run_case.materials.film.surface_tension = 0.034;
  run_case.rearrangement.max_time = 1e9;
  run_case.foam.equilibrate = true;
  run_case.foam.cluster =
      simulation::ClusterShape{.count = 7, .mean_diameter = 10e-3, .spread = 0.1, .seed = 3, .center = {}};
  FoamRun run(communicator, run_case);
  const double area_before = mesh::film_area(run.foam().films);
  run.tear(1, 2);
  const double torn = mesh::film_area(run.foam().films);
  std::vector<double> area;
  const double end = scale == Scale::Full ? 0.1 : 0.05;
  double late_sum = 0, late_time = 0;
  run.move_until(end, [&](const simulation::MotionStep& step) {
    area.push_back(step.film_area);
    if (run.foam().time < 0.7 * end) return true;
    late_sum += step.film_area * step.limit.dt;
    late_time += step.limit.dt;
    return true;
  });
  run.equilibrate();
  const double rest = mesh::film_area(run.foam().films);
  report.told("area before, with the film [m²]", area_before, "equilibrium of seven");
  report.told("area without the film [m²]", torn, "the start");
  report.relative("mean area late in the run [m²]", late_sum / late_time, rest, 5e-3,
                  "the smaller cluster in equilibrium (relaxed without gas)");
  report.at_least("waves of the area, above a hundredth of its fall", count_waves(area, 0.01 * (torn - rest)),
                  3, "Fig. 12: capillary waves");
  report.at_most("equilibrium area over the area at the start", rest / torn, 1, "area only falls");
}

void fig13_oscillation(const parallel::Communicator& communicator, Scale scale, Report& report) {
  report.note("two bubbles that overlap slightly merge into one of radius 20 mm, gas and films of Table 5");
  const bool full = scale == Scale::Full;
  const WaveMaterials gas{1.15, 3.42e-5, 2 * 0.034};
  const int cells = full ? 64 : 32;
  const double radius = 20e-3, h = full ? radius / 14 : radius / 7, half = 0.5 * cells * h;
  simulation::Case run_case;
  run_case.box = {{-half, -half, -1.5 * half}, {half, half, 1.5 * half}, {cells, cells, 3 * cells / 2}};
  run_case.materials.gas = {.density = gas.density, .viscosity = gas.viscosity};
  run_case.materials.film.surface_tension = 0.5 * gas.film_tension;
  run_case.rearrangement.max_time = 1e9;
  const double part = radius / std::cbrt(2.0), apart = 0.95 * part;
  for (const double z : {-apart, apart})
    run_case.foam.bubble.push_back({{1e-5, 2e-5, z}, {part, part, part}});
  run_case.foam.remove_lamella = {{1, 2}};
  FoamRun run(communicator, run_case);
  const double merged = std::cbrt(3 * run.foam().phases.target_volume[1] / (4 * std::numbers::pi));
  const Decay exact = bubble_mode(2, merged, gas);
  const double period = 2 * std::numbers::pi / exact.omega;
  std::vector<double> time, value;
  run.move_until((full ? 16 : 12) * period, [&](const simulation::MotionStep&) {
    time.push_back(run.foam().time);
    value.push_back(mode_amplitude(run.foam().films, 1, 2));
    return true;
  });
  std::size_t first = 0;
  while (time[first] < 0.65 * time.back()) ++first;  // the first swings are too wide for the linear law
  const auto late = std::span(value).subspan(first);
  const Decay fit = fit_damped_cosine(std::span(time).subspan(first), late, exact);
  report.told("largest amplitude in the fit over the radius", std::ranges::max(late) / merged,
              "small: linear law");
  report.relative("frequency of mode 2 [Hz]", fit.omega / (2 * std::numbers::pi),
                  exact.omega / (2 * std::numbers::pi), 0.03, "exact viscous law of the merged bubble");
  report.told("damping of mode 2 [1/s]", fit.gamma, "the same; its layer is thinner than a cell",
              exact.gamma);
  report.absolute("bubbles", run.foam().phases.n_bubbles(), 1, 0, "Fig. 13");
}

}  // namespace spume::verification
