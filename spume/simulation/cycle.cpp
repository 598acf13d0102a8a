#include "spume/simulation/cycle.hpp"

#include <algorithm>

#include "spume/simulation/drain_films.hpp"
#include "spume/simulation/rearrange.hpp"
#include "spume/simulation/tear.hpp"

namespace spume::simulation {

namespace {

bool includes(const Case& run_case, Stage stage) {
  const auto& stages = run_case.cycle.stages;
  return std::find(stages.begin(), stages.end(), stage) != stages.end();
}

void enter(Stage stage, RunState& run, Witness& witness) {
  run.stage = stage;
  run.rearrange = {};
  witness.checkpoint(run);
}

}  // namespace

bool is_over(const Case& run_case, const RunState& run) {
  const int bubbles = run.foam.phases.n_bubbles();
  const bool collapsed = bubbles == 0 || (bubbles == 1 && run.bubbles_at_start > 1);
  return collapsed || run.ruptures >= run_case.cycle.max_ruptures || run.foam.time >= run_case.cycle.end_time;
}

void cycle(const grid::Grid& grid, const Case& run_case, RunState& run, Witness& witness) {
  while (run.foam.phases.n_bubbles() > 0) {
    if (run.stage == Stage::Rearrange) {
      if (includes(run_case, Stage::Rearrange)) rearrange(grid, run_case, run, witness);
      const bool nothing_follows = !includes(run_case, Stage::Drain) && !includes(run_case, Stage::Rupture);
      if (is_over(run_case, run) || nothing_follows) return;
      enter(Stage::Drain, run, witness);
    }
    const auto weakest = includes(run_case, Stage::Drain)     ? drain_films(grid, run_case, run, witness)
                         : includes(run_case, Stage::Rupture) ? weakest_lamella(grid, run_case, run.foam)
                                                              : std::nullopt;
    if (!weakest || !includes(run_case, Stage::Rupture)) return;
    run.stage = Stage::Rupture;
    const auto update = tear(grid, run_case, weakest->phase_a, weakest->phase_b, run.foam);
    ++run.ruptures;
    witness.events(update.events);
    witness.step(run, update.topology, {.correction = update.energy_correction}, "rupture");
    witness.frame(run, update.topology, run_case.output.rearrangement_interval);
    enter(Stage::Rearrange, run, witness);
  }
}

}  // namespace spume::simulation
