#pragma once

#include "spume/simulation/run_state.hpp"
#include "spume/simulation/witness.hpp"

namespace spume::simulation {

/// Parts A and B of the paper: gas and films move until the foam is near equilibrium, the stage's time or the
/// run's time is up. Goes on from run.rearrange. Each step: film forces, gas, films (in this order: moving
/// the films with the old velocity is unstable). Collective. Throws Interrupted, with a checkpoint written,
/// when the user wants to stop.
void rearrange(const grid::Grid& grid, const Case& run_case, RunState& run, Witness& witness);

}  // namespace spume::simulation
