#pragma once

#include "spume/simulation/run_state.hpp"
#include "spume/simulation/witness.hpp"

namespace spume::simulation {

/// Whether nothing of what the case asks for is left: one bubble (or none), its ruptures, or its end time.
bool is_over(const Case& run_case, const RunState& run);

/// The life of a foam (paper, Figs. 2 and 4): rearrangement, drainage, rupture, and again, until one bubble
/// is left, nothing ruptures any more, or the case's end time or number of ruptures is reached. Goes on from
/// run.stage. Collective. Throws Interrupted when the user wants to stop.
void cycle(const grid::Grid& grid, const Case& run_case, RunState& run, Witness& witness);

}  // namespace spume::simulation
