#pragma once

#include "spume/simulation/run_state.hpp"
#include "spume/simulation/witness.hpp"

namespace spume::simulation {

/// The life of a foam (paper, Figs. 2 and 4): rearrangement, drainage, rupture, and again, until one bubble is left,
/// nothing ruptures any more, or the case's end time or number of ruptures is reached. Goes on from run.stage.
/// Collective. Throws Interrupted when the user wants to stop.
void cycle(const grid::Grid& grid, const Case& run_case, RunState& run, Witness& witness);

}  // namespace spume::simulation
