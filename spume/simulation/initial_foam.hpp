#pragma once

#include <string>
#include <vector>

#include "spume/simulation/case.hpp"
#include "spume/simulation/equilibrate.hpp"
#include "spume/state/events.hpp"
#include "spume/state/foam.hpp"

namespace spume::simulation {

/// Films, phases, gas at rest and liquid at time 0: the films of start_of(), reconstructed; relaxed
/// to equilibrium where the case asks, which `on_step` watches and may stop; lamellae removed as asked.
/// Events tell of pockets and lost bubbles. Collective.
void make_initial_foam(
    const Case& run_case, state::Foam& foam, std::vector<state::Event>& events,
    const OnRelaxStep& on_step = [](const auto&, const auto&) { return true; });

}  // namespace spume::simulation
