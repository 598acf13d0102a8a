#pragma once

#include <functional>
#include <string>

#include "spume/interface/relax.hpp"
#include "spume/simulation/film_update.hpp"

namespace spume::simulation {

struct EquilibrateReport {
  int n_steps = 0, n_reconstructions = 0;
  double virial_error = 1;  ///< |(2/3) 2σA / Σ p_i V_i − 1| at the end; 0 where it says nothing
  double area_change = 1;   ///< relative, of the last step
  bool converged = false;
};

/// "virial identity off by 1e-05"; of a foam that has no outer pressure, that there is none.
std::string virial_text(const EquilibrateReport& report);

/// Called after every step; return false to stop.
using OnRelaxStep = std::function<bool(const interface::RelaxStepReport&, const mesh::Topology&)>;

/// Relaxes the films to equilibrium without gas (implicit volume-constrained curvature flow), reconstructing
/// after half a cell of motion or every 25 steps. Converged when the area changes by less than 1e-6 a step,
/// in the stretch between two reconstructions. Collective.
EquilibrateReport equilibrate(const grid::Grid& grid, const Case& run_case, state::Foam& foam,
                              std::vector<state::Event>& events, const OnRelaxStep& on_step);

}  // namespace spume::simulation
