#pragma once

#include <vector>

#include "spume/simulation/case.hpp"
#include "spume/state/foam.hpp"

namespace spume::simulation {

/// How far a rearrangement stage has got; empty before it starts.
struct RearrangeState {
  double elapsed = 0;  ///< since the stage began [s]
  int steps_since_reconstruction = 0;
  std::vector<Vec3> reference;  ///< vertices just after the last reconstruction [m]
  std::vector<double> recent_time, recent_kinetic_energy, recent_area,
      recent_virial;  ///< the window that equilibrium looks at
};

/// Where a run stands: the foam and the counters. A checkpoint holds exactly this.
struct RunState {
  explicit RunState(const grid::Grid& grid) : foam(grid) {}

  state::Foam foam;
  Stage stage = Stage::Rearrange;  ///< the one under way
  RearrangeState rearrange;
  long step = 0;  ///< lines of history so far
  int ruptures = 0;
  int bubbles_at_start = 0;
  double next_frame = 0;   ///< [s]
  bool has_frame = false;  ///< the present state is among the frames already
  bool finished = false;
};

}  // namespace spume::simulation
