#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "spume/mesh/measure.hpp"
#include "spume/verification/foam_run.hpp"
#include "spume/verification/tables.hpp"

namespace spume::verification {

namespace {

struct Rearranged {
  double volume_error = 0;  ///< largest of any bubble and step, relative to its target
  long n_t1 = 0;
  int n_bubbles = 0;
};

/// Twenty bubbles of mean radius `cells_per_radius` h from overlapping spheres, for four capillary times.
Rearranged rearrange(const parallel::Communicator& communicator, int cells, double cells_per_radius) {
  const Units units = units_of_laplace_number(1e4);
  auto run_case = cube_case(units, cells, cells_per_radius);
  run_case.foam.cluster = simulation::ClusterShape{
      .count = 20, .mean_diameter = 2 * units.radius, .spread = 0.15, .seed = 4, .center = {}};
  FoamRun run(communicator, run_case);
  Rearranged result;
  run.move_until(4 * units.time(), [&](const simulation::MotionStep&) {
    const auto& phases = run.foam().phases;
    const auto volume = mesh::phase_volumes(run.foam().films, phases.count());
    for (mesh::Phase p = 1; p < phases.count(); ++p)
      if (phases.alive(p))
        result.volume_error =
            std::max(result.volume_error, std::abs(volume[p] / phases.target_volume[p] - 1));
    return true;
  });
  result.n_t1 = std::ranges::count(run.events, "T1", &state::Event::kind);
  result.n_bubbles = run.foam().phases.n_bubbles();
  return result;
}

}  // namespace

void bubble_volumes(const parallel::Communicator& communicator, Scale scale, Report& report) {
  report.note("twenty bubbles find their places, La = 1e4, four capillary times");
  const auto judge = [&](const std::string& what, const Rearranged& result, double limit) {
    report.at_most(what + ": largest volume error of a bubble", result.volume_error, limit, "targets");
    report.at_least(what + ": T1 events", static_cast<double>(result.n_t1), 1, "a rearrangement that tests");
    report.absolute(what + ": bubbles left", result.n_bubbles, 20, 0, "none is lost");
  };
  if (scale == Scale::Full) judge("64³, 14 cells across", rearrange(communicator, 64, 7), 1e-4);
  judge("40³, 6 cells across", rearrange(communicator, 40, 3), 1e-2);
}

}  // namespace spume::verification
