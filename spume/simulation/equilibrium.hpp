#pragma once

#include "spume/simulation/run_state.hpp"
#include "spume/state/materials.hpp"

namespace spume::simulation {

/// How far from rest a foam is. The kinetic energy of an oscillation of relative amplitude ε is of order ε²
/// of the film energy 2σA, and passes through zero twice a period, so its largest value over a window of one
/// period of the mean bubble (3 sqrt(ρ R³/2σ), the mode n = 2 has 2.9) is what counts.
struct EquilibriumMeasure {
  double amplitude = 1e300;    ///< sqrt(max kinetic energy over the window / 2σA)
  double area_change = 1e300;  ///< relative, over the window
  bool window_full = false;

  bool reached(double tolerance) const {
    return window_full && amplitude < tolerance && area_change < 0.1 * tolerance;
  }
};

/// Radius of the sphere of the mean bubble volume [m].
double mean_bubble_radius(const state::Phases& phases);

/// Length of the window [s].
double equilibrium_window(const state::Phases& phases, const state::Materials& materials);

/// Adds the present to the window of `rearrange`, forgets what is older, and measures.
EquilibriumMeasure measure_equilibrium(RearrangeState& rearrange, double window, double kinetic_energy,
                                       double film_area, double surface_tension);

}  // namespace spume::simulation
