#pragma once

#include <memory>
#include <string>

#include "spume/base/stage_times.hpp"
#include "spume/grid/elliptic.hpp"
#include "spume/state/gas_flow.hpp"
#include "spume/state/materials.hpp"

namespace spume::flow {

struct FlowParameters {
  grid::EllipticBackend elliptic = grid::EllipticBackend::Trigonometric;
  double elliptic_tolerance = 1e-10;  ///< of the multigrid backend
  bool limit_slopes = true;           ///< off for convergence studies on smooth flows
};

/// A limit on the time step and why.
struct StepLimit {
  double dt;           ///< [s]
  std::string reason;  ///< "advection", "capillary waves", …
};

/// Incompressible flow of the gas by the projection method of Sec. 3.2.1: unsplit Godunov advection,
/// Crank–Nicolson viscosity, approximate projection of the increment; see Eqs. (7) and (8).
///
/// Paper: Sec. 2.2.1, Eq. (2).
///   ρ (u_t + u·∇u) = −∇p + μ ∇²u + st,   ∇·u = 0
///
/// Velocity and pressure at cell centres. Second order in h and Δt together on smooth flows. Conserves the
/// momentum of a periodic box.
class NavierStokes {
 public:
  NavierStokes(const grid::Grid& grid, const state::Gas& gas, const FlowParameters& parameters);
  ~NavierStokes();

  /// Advances `flow` by dt under a body force density [N/m³]. Stable for advection CFL numbers up to ½; the
  /// body force is explicit and has its own limit, see capillary_limit(). Collective.
  ///
  /// Throws NumericalError when the result is not finite.
  void step(state::GasFlow& flow, const grid::VectorField& body_force, double dt);

  /// Processor time of all steps so far: ghosts and explicit terms, advection, MAC projection, diffusion,
  /// projections.
  const StageTimes& times() const;

  /// The velocity with which films move, on faces (grid::Placement::Faces): wide means of cells, made free of
  /// divergence by the MAC projection. What the approximate projection of a step leaves of the gradients in
  /// newly spread forces would else move the films, and damp them. Collective.
  void film_velocity(const state::GasFlow& flow, grid::VectorField& on_faces);

  /// dt ≤ cfl h / max|u|. Collective.
  StepLimit advection_limit(const state::GasFlow& flow, double cfl) const;

 private:
  struct Implementation;
  std::unique_ptr<Implementation> implementation_;
};

/// dt ≤ C sqrt(ρ h³ / (2σ)): capillary waves of the shortest length that the kernel lets through, C = 0.8.
StepLimit capillary_limit(double h, const state::Materials& materials, double factor = 0.8);

/// ∫ ½ρ|u|² [J]. Collective.
double kinetic_energy(const state::GasFlow& flow, double density);
/// max |u| [m/s]. Collective.
double max_speed(const state::GasFlow& flow);

}  // namespace spume::flow
