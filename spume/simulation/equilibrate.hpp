#pragma once

#include <functional>

#include "spume/interface/relax.hpp"
#include "spume/simulation/film_update.hpp"

namespace spume::simulation {

struct EquilibrateReport {
  int n_steps = 0, n_reconstructions = 0;
  double virial_error = 1;  ///< |(2/3) 2σA / Σ p_i V_i − 1| at the end
  double area_change = 1;   ///< relative, of the last step
  double area_to_fall = 1;  ///< relative, estimated from how the steps shrink
  bool converged = false;
};

/// Called after every step; return false to stop.
using OnRelaxStep = std::function<bool(const interface::RelaxStepReport&, const mesh::Topology&)>;

/// Relaxes the films to equilibrium without gas (implicit volume-constrained curvature flow), reconstructing
/// after half a cell of motion, where triangles have become poor (edges below 0.2 h, angles below 15
/// degrees), and to confirm an equilibrium that is more than a tenth of a cell from the last reconstruction.
/// A step that would raise the area is taken again with a quarter of its length. Converged when the area has
/// less than 3e-6 to fall and the virial identity holds within 1e-4. Collective.
EquilibrateReport equilibrate(const grid::Grid& grid, const Case& run_case, state::Foam& foam,
                              std::vector<state::Event>& events, const OnRelaxStep& on_step);

}  // namespace spume::simulation
