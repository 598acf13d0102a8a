#pragma once

namespace spume::drainage {

/// A moment inside a drainage step: its distance from the beginning of the step [s], and ln(η/threshold)
/// there.
struct Moment {
  double since_step;
  double log_excess;
};

/// When η falls to the threshold between two moments of a step that began at `elapsed` [s] of the stage. The
/// thinnest η falls about as a power of time, so ln η is interpolated linearly in ln t (in t, if the step is
/// the first). Takes: before.log_excess ≥ 0 > after.log_excess. Gives: seconds since the beginning of the
/// step.
double crossing_time(double elapsed, const Moment& before, const Moment& after);

}  // namespace spume::drainage
