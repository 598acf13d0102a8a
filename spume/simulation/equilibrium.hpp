#pragma once

#include <span>

#include "spume/mesh/film_mesh.hpp"
#include "spume/simulation/run_state.hpp"
#include "spume/state/materials.hpp"

namespace spume::simulation {

/// How far from rest a foam is. The kinetic energy of an oscillation of relative amplitude ε is of order ε²
/// of the film energy 2σA, and passes through zero twice a period, so its largest value over a window of one
/// period of the mean bubble (3 sqrt(ρ R³/2σ), the mode n = 2 has 2.9) is what counts. Foams that move slowly
/// have little kinetic energy far from equilibrium too: there the area still changes, and the virial identity
/// does not hold yet.
struct EquilibriumMeasure {
  double amplitude = 1e300;     ///< sqrt(max kinetic energy over the window / 2σA)
  double area_change = 1e300;   ///< relative, over the window
  double virial_error = 1e300;  ///< |mean of virial_ratio() over the window − 1|
  bool window_full = false;

  bool reached(double tolerance) const {
    return window_full && amplitude < tolerance && area_change < 0.1 * tolerance &&
           virial_error < 2 * tolerance;
  }
};

/// Radius of the sphere of the mean bubble volume [m].
double mean_bubble_radius(const state::Phases& phases);

/// Length of the window [s].
double equilibrium_window(const state::Phases& phases, const state::Materials& materials);

/// Σ_i (p_i − p_0) V_i over (2/3) 2σA: one in equilibrium, for a foam that is dilated by 1 + ε does the work
/// 3ε Σ (p_i − p_0) V_i and gains the film energy 2ε 2σA. `pressure` [Pa] of each phase, relative to the
/// outside, at the film area [m²] given. A foam without film to the outside has no such identity: one.
double virial_ratio(const mesh::FilmMesh& films, const state::Phases& phases,
                    std::span<const double> pressure, double film_area, double surface_tension);

/// Adds the present to the window of `rearrange`, forgets what is older, and measures.
EquilibriumMeasure measure_equilibrium(RearrangeState& rearrange, double window, double kinetic_energy,
                                       double film_area, double virial, double surface_tension);

}  // namespace spume::simulation
