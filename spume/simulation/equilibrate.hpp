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
  double area_to_fall = 1;  ///< relative, estimated from how the steps shrink
  bool converged = false;
};

/// "virial identity off by 1e-05"; of a foam that has no outer pressure, that there is none.
std::string virial_text(const EquilibrateReport& report);

/// Called after every step, but for those that only take off what a reconstruction without topological change
/// has added to the area (ten at most): so the area falls from call to call, but for T1s and for triangles
/// that are flipped and collapsed. Return false to stop.
using OnRelaxStep = std::function<bool(const interface::RelaxStepReport&, const mesh::Topology&)>;

/// Relaxes the films to equilibrium without gas: implicit volume-constrained curvature flow, accelerated by
/// going ahead of each step along the last (Nesterov, Soviet Math. Dokl. 27, 1983, 372–376; from rest again
/// after a step that would have raised the area, O'Donoghue and Candès, Found. Comput. Math. 15, 2015,
/// 715–732). A step that would raise the area from where the films are is taken again with a quarter of its
/// length. Triangles that become poor (angles below 6 degrees or edges below 0.08 h on the way, 15 degrees
/// and 0.2 h at rest) are flipped and collapsed on the mesh. The films are reconstructed after 1.5 cells of
/// motion, and after half a cell or at rest if a lamella or border has become smaller than 0.3 h, which then
/// vanishes or comes back larger. At rest when the area has less than 1e-5 to fall and the virial identity
/// holds within 1e-4, first on the ordinary mesh, then on a finer one (edges of 0.57 h in the mean), which
/// the foam keeps. A foam without films is at rest. Its liquid goes along with films that stretch evenly
/// (transport::stretch_evenly). Collective.
EquilibrateReport equilibrate(const grid::Grid& grid, const Case& run_case, state::Foam& foam,
                              std::vector<state::Event>& events, const OnRelaxStep& on_step);

}  // namespace spume::simulation
