#pragma once

#include "spume/base/vec3.hpp"

namespace spume::state {

struct Gas {
  double density = 1.2;       ///< ρ_g [kg/m³]
  double viscosity = 1.8e-5;  ///< μ_g [Pa s]
};
struct Liquid {
  double density = 1000;    ///< ρ [kg/m³]
  double viscosity = 1e-3;  ///< μ [Pa s]
};
struct Film {
  double surface_tension = 0.03;  ///< σ of one liquid–gas face [N/m]; a film pulls with 2σ
};

/// What the foam is made of.
struct Materials {
  Gas gas;
  Liquid liquid;
  Film film;
  Vec3 gravity;  ///< g [m/s²]; acts on the liquid of the films
};

}  // namespace spume::state
