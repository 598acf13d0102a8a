#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "spume/parallel/communicator.hpp"
#include "spume/simulation/case.hpp"
#include "spume/simulation/foam_motion.hpp"
#include "spume/verification/exact_waves.hpp"

namespace spume::verification {

/// Scales that make the studies comparable: results are in units of these.
struct Units {
  double radius;   ///< R [m]
  double tension;  ///< T = 2σ [N/m]
  double density;  ///< ρ of the gas [kg/m³]
  double viscosity;

  double time() const;      ///< capillary time sqrt(ρR³/T) [s]
  double speed() const;     ///< sqrt(T/(ρR)) [m/s]
  double pressure() const;  ///< T/R [Pa]
  WaveMaterials materials() const { return {density, viscosity, tension}; }
};

/// Soap film and air around bubbles of radius R = 1 mm, with the viscosity that gives the Laplace number
/// La = 2σρ·2R/μ².
Units units_of_laplace_number(double laplace);
/// The same with μ in units of sqrt(ρ T R).
Units units_of_viscosity(double viscosity);

/// A case with one stage of rearrangement without end, in a periodic cube of `cells` cells an edge that is
/// `cells`/`cells_per_radius` R wide and has the origin in its middle.
simulation::Case cube_case(const Units& units, int cells, double cells_per_radius);

/// A foam with its grid, to be moved step by step.
class FoamRun {
 public:
  /// The case's own bubbles. Collective.
  FoamRun(const parallel::Communicator& communicator, simulation::Case run_case);
  /// Bubbles 1 … n of functions, phase 0 the outside, as in interface::construct(). Collective.
  FoamRun(const parallel::Communicator& communicator, simulation::Case run_case, int n_bubbles,
          const std::function<double(mesh::Phase, const Vec3&)>& potential);

  const simulation::Case& run_case() const { return case_; }
  const grid::Grid& grid() const { return grid_; }
  state::Foam& foam() { return run_.foam; }
  const mesh::Topology& topology();
  /// The velocity, on faces, that moved the films in the last step; sampled by grid::KernelCoupling.
  const grid::VectorField& film_velocity() { return motion().film_velocity(); }

  /// Gas and films until `time` [s] since the start; `after_step` sees every step and stops the run by false.
  /// Collective.
  void move_until(double time, const std::function<bool(const simulation::MotionStep&)>& after_step = {});
  /// Relaxes the films without gas. Collective.
  void equilibrate();
  /// Reconstructs the films now. Collective.
  simulation::FilmUpdate reconstruct();
  /// Removes the films between two phases. Collective.
  simulation::FilmUpdate tear(mesh::Phase a, mesh::Phase b);
  /// Gives every bubble the volume that it has.
  void accept_volumes();
  /// Starts the motion anew after the films were changed from outside.
  void forget_motion();

  std::vector<state::Event> events;  ///< since the start

 private:
  simulation::FoamMotion& motion();

  simulation::Case case_;
  grid::Grid grid_;
  simulation::RunState run_;
  std::unique_ptr<simulation::FoamMotion> motion_;
  mesh::Topology topology_;
};

/// Pressures of the phases from the film forces [Pa], relative to the outside.
std::vector<double> bubble_pressures(FoamRun& run);
/// |Σ p_i V_i / ((2/3) T A) − 1| with those pressures.
double virial_error(FoamRun& run);

}  // namespace spume::verification
