#pragma once

#include <functional>
#include <vector>

#include "spume/mesh/phase_set.hpp"
#include "spume/simulation/case.hpp"

namespace spume::simulation {

/// Where the phases lie at time 0.
struct Start {
  std::vector<double> target_volume;  ///< of each phase, the outside first [m³]; 0: as the films enclose it
  std::function<double(mesh::Phase, const Vec3&)> potential;  ///< as interface::construct() wants it [m]
  mesh::Phase above_membrane = 0;                             ///< the outside above a membrane; 0 without one
};

/// The start that the case asks for. Deterministic. Throws as bubbles_of().
Start start_of(const Case& run_case);

/// The bubbles that the case asks for: its own list, then those of its cluster; of a lattice,
/// an image or films, spheres of the volumes and places of its bubbles. Deterministic. Throws InputError when
/// a bubble of a list or cluster reaches within four cells of the edge of the box, or there is none.
std::vector<BubbleShape> bubbles_of(const Case& run_case);

}  // namespace spume::simulation
