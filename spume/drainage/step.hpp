#pragma once

#include <numbers>

#include "spume/drainage/equations.hpp"

namespace spume::drainage {

enum class Method {
  Rosenbrock,  ///< ROS2, second order, L-stable
  Euler,       ///< linearly implicit Euler, first order; keeps η and λ positive where ROS2 may not
};

/// When a step of ROS2 from t takes liquid that comes from elsewhere, in units of Δt after t: γ in
/// Stepper::start() and 1 − γ in Stepper::attempt(). To the order of the scheme these are the terms
/// F + γ Δt F_t and F(t + Δt) − γ Δt F_t that it asks for where F depends on time.
inline constexpr double first_gain = 1 - 1 / std::numbers::sqrt2, second_gain = 1 / std::numbers::sqrt2;

/// Where a step did worst: one film dof or one border unknown, the other −1.
struct WorstUnknown {
  int film_dof = -1, border_unknown = -1;
};

/// A step that was tried, not yet accepted. Where it is not positive, only `worst` means something.
struct Trial {
  Unknowns y;             ///< at the end of the step
  bool positive = false;  ///< every η and λ of its stages is finite and positive
  double error = 0;       ///< largest estimate, relative to the lesser of old and new value plus a floor
  WorstUnknown worst;
};

/// Tries steps of different length from one state; J and F(y) are evaluated once for all of them.
///   ROS2, γ = 1 − 1/√2:  (M − γ Δt J) k₁ = F(y),  (M − γ Δt J) k₂ = F(y + Δt k₁) − 2 M k₁,
///                        y⁺ = y + Δt (3k₁ + k₂)/2,  error Δt |k₁ + k₂|/2
///   Euler:               (M − Δt J) k = F(y),  y⁺ = y + Δt k,  error from (M − Δt J) e = (Δt/2)(F(y⁺) − M k)
/// ROS2 is second order for any J (Verwer, Spee, Blom, Hundsdorfer, SIAM J. Sci. Comput. 20, 1999), hence
/// also for the J without ∂Q/∂λ. Liquid is kept to round-off in each step. Collective over the ranks of the
/// equations: all of them have the same numbers and come to the same decisions.
class Stepper {
 public:
  explicit Stepper(DrainageEquations& equations) : equations_(equations) {}

  /// Starts from y, with all η, λ > 0. `gain`, if any, adds to the balances of film dofs (of one face) and
  /// border unknowns what comes from elsewhere [m³/s].
  void start(const Unknowns& y, const Unknowns* gain = nullptr);
  /// Tries one step of dt [s], with that gain later in the step.
  const Trial& attempt(Method method, double dt, const Unknowns* gain = nullptr);

  /// F of the state started from [m³/s]; film rows of the lamellae of this rank.
  const Unknowns& initial_rates() const { return initial_rates_; }

 private:
  void rosenbrock(double dt, const Unknowns* gain);
  void euler(double dt, const Unknowns* gain);
  void evaluate_rates(const Unknowns& y, const Unknowns* gain, Unknowns& rate);
  /// to = start + dt (c₁ k₁ + c₂ k₂)
  void combine(double dt, double c1, double c2, Unknowns& to) const;
  bool check_positive(const Unknowns& y);
  /// Largest |scale (c₁ k₁ + k₂)| relative to the values at both ends of the step.
  void measure_error(double scale, double c1);

  DrainageEquations& equations_;
  Unknowns start_, initial_rates_, k1_, k2_, stage_;
  Trial trial_;
};

}  // namespace spume::drainage
