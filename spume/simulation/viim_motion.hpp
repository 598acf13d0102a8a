#pragma once

#include "spume/grid/kernel_coupling.hpp"
#include "spume/mesh/topology.hpp"
#include "spume/simulation/run_state.hpp"
#include "spume/simulation/witness.hpp"
#include "spume/viim/film_evolution.hpp"

namespace spume::simulation {

/// The films of a rearrangement stage moved by the paper's interface method. φ and χ live as long as this
/// object does and are made from the film mesh, so a stage that is taken up from a checkpoint starts with φ
/// rebuilt.
class ViimMotion {
 public:
  /// `grid` and `run_case` must outlive it.
  ViimMotion(const grid::Grid& grid, const Case& run_case, const state::Foam& foam);

  /// Moves the films for dt [s] with the gas, whose velocity the kernel samples. The old mesh, carried by the
  /// gas, brings its liquid to the new one. Gives the area of the carried mesh [m²]. Collective.
  double move(RunState& run, const grid::VectorField& velocity, const grid::KernelCoupling& kernel, double dt,
              mesh::Topology& topology, Witness& witness);

 private:
  const Case& case_;
  double h_;
  viim::FilmEvolution evolution_;
};

}  // namespace spume::simulation
