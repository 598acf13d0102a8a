#include "spume/verification/drainage_runs.hpp"

#include <algorithm>
#include <cmath>

#include "spume/base/error.hpp"

namespace spume::verification {

state::Materials fig15_materials() {
  return {.gas = {.density = 1.15, .viscosity = 1.8e-5},
          .liquid = {.density = 1000, .viscosity = 1e-3},
          .film = {.surface_tension = 0.034},
          .gravity = {0, 0, -9.8}};
}

drainage::Unknowns march(drainage::DrainageEquations& equations, drainage::Unknowns y, double time, int n) {
  drainage::Stepper stepper(equations);
  for (int step = 0; step < n; ++step) {
    stepper.start(y);
    const drainage::Trial& trial = stepper.attempt(drainage::Method::Rosenbrock, time / n);
    if (!trial.positive) throw NumericalError("a step of fixed length left no positive half-thickness");
    y = trial.y;
  }
  return y;
}

void drain_with_held_borders(drainage::DrainageEquations& equations, drainage::Unknowns y,
                             std::span<const double> times, double tolerance,
                             const std::function<void(std::size_t, const drainage::Unknowns&)>& at) {
  drainage::Stepper stepper(equations);
  const std::vector<double> held = y.border;
  double t = 0, dt = 1e-6 * times.back();
  for (std::size_t n = 0; n < times.size(); ++n) {
    while (t < times[n]) {
      const double step = std::min(dt, times[n] - t);
      stepper.start(y);
      const drainage::Trial& trial = stepper.attempt(drainage::Method::Rosenbrock, step);
      const double error = trial.error / tolerance;
      const bool accepted = trial.positive && error <= 1;
      dt = step * (trial.positive ? std::clamp(0.85 / std::sqrt(std::max(error, 1e-12)), 0.2, 2.0) : 0.25);
      if (dt < 1e-12 * times.back()) throw NumericalError("drainage with held borders stalled");
      if (!accepted) continue;
      y = trial.y;
      y.border = held;
      t = step == times[n] - t ? times[n] : t + step;
    }
    at(n, y);
  }
}

double order_of(double coarse, double fine, double ratio) {
  return std::log(std::abs(coarse / fine)) / std::log(ratio);
}

}  // namespace spume::verification
