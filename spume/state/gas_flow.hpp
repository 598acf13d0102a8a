#pragma once

#include "spume/grid/field.hpp"

namespace spume::state {

/// The gas: velocity u^n [m/s] and pressure p^{n−½} [Pa] at cell centres. The pressure lacks the part that is
/// constant in each bubble, which the film forces carry (see flow/surface_tension.hpp).
struct GasFlow {
  explicit GasFlow(const grid::Grid& grid) : velocity(grid), pressure(grid) {}
  grid::VectorField velocity;
  grid::Field pressure;
};

}  // namespace spume::state
