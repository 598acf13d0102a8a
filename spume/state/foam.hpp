#pragma once

#include "spume/mesh/film_mesh.hpp"
#include "spume/state/film_liquid.hpp"
#include "spume/state/gas_flow.hpp"
#include "spume/state/phases.hpp"

namespace spume::state {

/// A foam at one instant: all that a run needs to go on.
struct Foam {
  explicit Foam(const grid::Grid& grid) : gas(grid) { films.domain = grid.box().domain(); }

  double time = 0;  ///< [s]
  mesh::FilmMesh films;
  Phases phases;
  FilmLiquid liquid;
  GasFlow gas;
};

}  // namespace spume::state
