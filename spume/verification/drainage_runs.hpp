#pragma once

#include <functional>
#include <span>

#include "spume/drainage/step.hpp"
#include "spume/state/film_network.hpp"
#include "spume/state/materials.hpp"

namespace spume::verification {

/// The liquid and faces of the foam of the paper's Fig. 15; g along −z.
state::Materials fig15_materials();

/// Drains by n equal steps of ROS2 over `time` [s]. Throws NumericalError where η or λ does not stay
/// positive.
drainage::Unknowns march(drainage::DrainageEquations& equations, drainage::Unknowns y, double time, int n);

/// Drains with λ put back to its first values after every step, steps chosen for a relative error of
/// `tolerance` each, and calls at(n, y) at times[n] [s], increasing. Throws NumericalError where steps become
/// tiny.
void drain_with_held_borders(drainage::DrainageEquations& equations, drainage::Unknowns y,
                             std::span<const double> times, double tolerance,
                             const std::function<void(std::size_t, const drainage::Unknowns&)>& at);

/// Observed order of convergence from errors at spacings in the ratio `ratio`.
double order_of(double coarse, double fine, double ratio = 2);

}  // namespace spume::verification
