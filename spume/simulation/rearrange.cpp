#include "spume/simulation/rearrange.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <optional>

#include "spume/base/error.hpp"
#include "spume/flow/navier_stokes.hpp"
#include "spume/simulation/equilibrate.hpp"
#include "spume/simulation/equilibrium.hpp"
#include "spume/simulation/foam_motion.hpp"

namespace spume::simulation {

namespace {

/// Without gas: the overdamped motion of the films to equilibrium, at no cost of simulated time.
void rearrange_quasistatically(const grid::Grid& grid, const Case& run_case, RunState& run,
                               Witness& witness) {
  std::vector<state::Event> events;
  bool stopped = false;
  const auto report =
      equilibrate(grid, run_case, run.foam, events, [&](const auto&, const mesh::Topology& topology) {
        witness.step(run, topology, {}, "relaxation");
        return !(stopped = witness.stop_wanted());
      });
  witness.events(events);
  if (stopped) {
    witness.checkpoint(run);
    throw Interrupted("stopped in the relaxation; the state was saved");
  }
  witness.frame(run, mesh::build_topology(run.foam.films), run_case.output.rearrangement_interval);
  witness.event(run, report.converged ? "equilibrium reached" : "equilibrium not reached",
                fmt::format("quasistatic; {} steps; {}; last relative change of area {:.2g}", report.n_steps,
                            virial_text(report), report.area_change));
}

}  // namespace

void rearrange(const grid::Grid& grid, const Case& run_case, RunState& run, Witness& witness) {
  if (run_case.rearrangement.dynamics == RearrangementParameters::Dynamics::Quasistatic)
    return rearrange_quasistatically(grid, run_case, run, witness);

  const double sigma = run_case.materials.film.surface_tension;
  const double window = equilibrium_window(run.foam.phases, run_case.materials);
  FoamMotion motion(grid, run_case, run);

  for (EquilibriumMeasure equilibrium;;) {
    const bool out_of_time =
        run.rearrange.elapsed >= run_case.rearrangement.max_time || run.foam.time >= run_case.cycle.end_time;
    if (equilibrium.reached(run_case.rearrangement.equilibrium_tolerance) || out_of_time) {
      witness.frame(run, motion.topology(), run_case.output.rearrangement_interval);
      witness.event(
          run, out_of_time ? "equilibrium not reached" : "equilibrium reached",
          run.rearrange.recent_time.empty()
              ? "no time for it"
              : fmt::format(
                    "after {:.4g} s; amplitude of motion {:.2g}; relative change of area {:.2g}; virial "
                    "identity off by {:.2g}",
                    run.rearrange.elapsed, equilibrium.amplitude, equilibrium.area_change,
                    equilibrium.virial_error));
      return;
    }
    if (run.foam.phases.n_bubbles() == 0) return;  // the last one was too small for the grid
    if (witness.stop_wanted()) {
      witness.checkpoint(run);
      throw Interrupted("stopped while the foam rearranged; the state was saved");
    }

    const MotionStep step = motion.step();
    witness.events(step.events);
    equilibrium =
        measure_equilibrium(run.rearrange, window, step.kinetic_energy, step.film_area, step.virial, sigma);
    witness.step(run, motion.topology(),
                 {.dt = step.limit.dt,
                  .kinetic_energy = step.kinetic_energy,
                  .max_speed = flow::max_speed(run.foam.gas),
                  .correction = step.correction},
                 step.limit.reason);
    witness.frame_if_due(run, motion.topology(), run_case.output.rearrangement_interval);
    witness.checkpoint_if_due(run);
  }
}

}  // namespace spume::simulation
