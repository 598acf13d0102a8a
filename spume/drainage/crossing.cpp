#include "spume/drainage/crossing.hpp"

#include <cmath>

namespace spume::drainage {

double crossing_time(double elapsed, const Moment& before, const Moment& after) {
  const double fraction = before.log_excess / (before.log_excess - after.log_excess);
  const double t0 = elapsed + before.since_step, t1 = elapsed + after.since_step;
  if (!(t0 > 0)) return before.since_step + fraction * (after.since_step - before.since_step);
  return before.since_step + t0 * std::expm1(fraction * std::log(t1 / t0));
}

}  // namespace spume::drainage
