#pragma once

#include <string>
#include <vector>

#include "spume/simulation/case.hpp"
#include "spume/state/events.hpp"
#include "spume/state/foam.hpp"

namespace spume::simulation {

/// The bubbles that the case asks for: its own list, then those of its cluster. Deterministic. Throws
/// InputError when a bubble reaches within four cells of the edge of the box, or there is none.
std::vector<BubbleShape> bubbles_of(const Case& run_case);

/// Films, phases, gas at rest and liquid at time 0: the power diagram of the bubbles, reconstructed; relaxed
/// to equilibrium where the case asks; lamellae removed as asked. Events tell of pockets and lost bubbles.
/// Collective.
void make_initial_foam(const Case& run_case, state::Foam& foam, std::vector<state::Event>& events);

}  // namespace spume::simulation
