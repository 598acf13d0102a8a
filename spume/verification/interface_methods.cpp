#include <fmt/format.h>

#include <chrono>
#include <cmath>
#include <numbers>

#include "spume/flow/navier_stokes.hpp"
#include "spume/mesh/measure.hpp"
#include "spume/verification/foam_run.hpp"
#include "spume/verification/tables.hpp"

namespace spume::verification {

namespace {

using Interface = simulation::RearrangementParameters::Interface;

struct Outcome {
  double area_error, volume_error, speed;  ///< speed in capillary units
  int n_lamellae, n_nonconforming;
  double seconds_a_step;
};

/// Two spheres of R that overlap too little, moved by gas for some capillary times.
Outcome double_bubble_by(Interface method, const parallel::Communicator& communicator, int cells_per_radius) {
  const Units units = units_of_laplace_number(400);
  auto run_case = cube_case(units, 5 * cells_per_radius, cells_per_radius);
  run_case.rearrangement.interface = method;
  const double r = units.radius, h = r / cells_per_radius;
  run_case.foam.bubble = {{{-0.65 * r, 0.2 * h, 0.3 * h}, {r, r, r}},
                          {{0.65 * r, 0.2 * h, 0.3 * h}, {r, r, r}}};
  FoamRun run(communicator, run_case);
  int n_steps = 0;
  const auto begun = std::chrono::steady_clock::now();
  run.move_until(4 * units.time(), [&](const simulation::MotionStep&) { return ++n_steps > 0; });
  const std::chrono::duration<double> spent = std::chrono::steady_clock::now() - begun;

  const auto& phases = run.foam().phases;
  const auto volume = mesh::phase_volumes(run.foam().films, phases.count());
  const double mean = 0.5 * (phases.target_volume[1] + phases.target_volume[2]);
  // Equal double bubble: V = 9πR³/8, A = 27πR²/4.
  const double exact_radius = std::cbrt(mean * 8 / (9 * std::numbers::pi));
  const double exact_area = 27 * std::numbers::pi * exact_radius * exact_radius / 4;
  double volume_error = 0;
  for (int p = 1; p < 3; ++p)
    volume_error = std::max(volume_error, std::abs(volume[p] / phases.target_volume[p] - 1));
  return {mesh::film_area(run.foam().films) / exact_area - 1,
          volume_error,
          flow::max_speed(run.foam().gas) / units.speed(),
          run.topology().n_lamellae(),
          run.topology().n_nonconforming_edges,
          spent.count() / n_steps};
}

}  // namespace

void interface_methods(const parallel::Communicator& communicator, Scale scale, Report& report) {
  report.note(
      "the carried film mesh beside the paper's VIIM: two spheres become a double bubble, 4 capillary times");
  for (int cells_per_radius : {6, 8, 12}) {
    if (scale == Scale::Small && cells_per_radius > 8) break;
    report.note(fmt::format("R = {} h", cells_per_radius));
    for (const auto& [method, name] : {std::pair{Interface::Mesh, "mesh"}, {Interface::Viim, "viim"}}) {
      const Outcome o = double_bubble_by(method, communicator, cells_per_radius);
      const auto quantity = [&, label = name](const char* what) {
        return fmt::format("{}: {}", label, what);
      };
      report.absolute(quantity("error of film area"), o.area_error, 0, 0.01, "equal double bubble");
      report.told(quantity("largest speed, sqrt(2σ/(ρR))"), o.speed, "at rest", 0.0);
      report.told(quantity("seconds a step"), o.seconds_a_step, "cost");
      report.at_most(quantity("error of volumes"), o.volume_error, 1e-3, "nothing is lost");
      report.absolute(quantity("lamellae"), o.n_lamellae, 3, 0, "double bubble");
      report.absolute(quantity("edges that do not conform"), o.n_nonconforming, 0, 0, "conforming mesh");
    }
  }
}

}  // namespace spume::verification
