#pragma once

#include <optional>
#include <vector>

#include "spume/base/stage_times.hpp"
#include "spume/flow/navier_stokes.hpp"
#include "spume/flow/surface_tension.hpp"
#include "spume/grid/kernel_coupling.hpp"
#include "spume/grid/sharpening.hpp"
#include "spume/mesh/topology.hpp"
#include "spume/simulation/film_update.hpp"
#include "spume/simulation/run_state.hpp"
#include "spume/simulation/viim_motion.hpp"
#include "spume/state/events.hpp"

namespace spume::simulation {

/// What a step of gas and films did.
struct MotionStep {
  flow::StepLimit limit;
  bool reconstructed = false;
  double film_area = 0;              ///< after the step [m²]
  double kinetic_energy = 0;         ///< after the step [J]
  double virial = 1;                 ///< virial_ratio() before the step [−]
  double correction = 0;             ///< of film energy by restored volumes and reconstruction [J]
  std::vector<state::Event> events;  ///< of a reconstruction
};

/// The gas and the films of a foam in motion, one step at a time: film forces, gas, films (in this order:
/// moving the films with the old velocity is unstable), volumes, and a reconstruction where one is due. Keeps
/// references to its arguments.
class FoamMotion {
 public:
  FoamMotion(const grid::Grid& grid, const Case& run_case, RunState& run);

  /// One step, no longer than the stage and the run allow; moves the clocks of the run. Collective.
  MotionStep step();
  /// Reconstructs the films now. Collective.
  FilmUpdate reconstruct();
  /// Of the present films.
  const mesh::Topology& topology() const { return topology_; }
  /// The velocity, on faces and sharpened, that moved the films in the last step.
  const grid::VectorField& film_velocity() const { return film_velocity_; }

  /// Processor time of the stages of all steps; "gas" is the whole of gas_times().
  const StageTimes& times() const { return times_; }
  const StageTimes& gas_times() const { return gas_.times(); }
  const StageTimes& reconstruction_times() const { return reconstruction_times_; }

 private:
  flow::StepLimit choose_step() const;
  double largest_normal_motion() const;
  double carry_films(double dt, std::vector<state::Event>& events);
  bool needs_reconstruction() const;

  const grid::Grid& grid_;
  const Case& case_;
  RunState& run_;
  grid::KernelCoupling kernel_;
  grid::Sharpening sharpening_;
  flow::NavierStokes gas_;
  flow::ForceSpreader spreader_;
  grid::VectorField force_, film_velocity_;
  mesh::Topology topology_;
  std::optional<ViimMotion> viim_;
  StageTimes times_, reconstruction_times_;
};

}  // namespace spume::simulation
