#pragma once

#include "spume/grid/kernel_coupling.hpp"
#include "spume/simulation/film_update.hpp"
#include "spume/viim/film_evolution.hpp"

namespace spume::simulation {

/// What a step did to the films.
struct ViimStep {
  double area_carried;  ///< of the old mesh as the gas carries it [m²]
  FilmUpdate update;
};

/// The films of a rearrangement stage moved by the paper's interface method. φ and χ live as long as this
/// object does and are made from the film mesh, so a stage that is taken up from a checkpoint starts with φ
/// rebuilt.
class ViimMotion {
 public:
  /// `grid` and `run_case` must outlive it.
  ViimMotion(const grid::Grid& grid, const Case& run_case, const state::Foam& foam);

  /// Moves the films for dt [s] with the gas, whose velocity lies where the kernel takes it. The old mesh,
  /// carried by the gas, brings its liquid to the new one; `topology` is that of foam.films as they come in.
  /// Collective.
  ViimStep move(state::Foam& foam, const mesh::Topology& topology, const grid::VectorField& velocity,
                const grid::KernelCoupling& kernel, double dt);

 private:
  const Case& case_;
  parallel::Communicator ranks_;
  double h_;
  viim::FilmEvolution evolution_;
};

}  // namespace spume::simulation
