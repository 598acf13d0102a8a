#pragma once

#include <vector>

#include "spume/config/entries.hpp"
#include "spume/config/problems.hpp"
#include "spume/simulation/case.hpp"

namespace spume::config {

/// Adds what contradicts itself in a case whose single values are right: corners of the box in the wrong
/// order, cells that are no cubes, bubbles that reach too near to the edge of the box, no bubble at all,
/// pairs of phases that do not exist. `bubble_places`: where each bubble of the list stands.
void cross_check(const simulation::Case& run_case, const Entries& entries,
                 const std::vector<Place>& bubble_places, Problems& problems);

}  // namespace spume::config
