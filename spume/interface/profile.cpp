#include "spume/interface/profile.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "spume/base/contract.hpp"

namespace spume::interface {

namespace {

double gaussian(double x, double variance) {
  return std::exp(-0.5 * x * x / variance) / std::sqrt(2 * std::numbers::pi * variance);
}

double profile_slope(double x, double variance) {
  const double u = x * x / variance;
  return (u * u - 10 * u + 15) / 8 * gaussian(x, variance);
}

/// Root of a monotonic function by bisection, to the last bit.
template <class Function>
double bisect(double low, double high, Function&& is_low) {
  for (int n = 0; n < 60; ++n) {
    const double middle = 0.5 * (low + high);
    (is_low(middle) ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

}  // namespace

double smoothing_kernel(double z) {
  return std::exp(-z) * smoothing_polynomial(z);
}

double flat_film_profile(double x, double variance) {
  const double u = x * x / variance;
  return 0.5 * std::erf(x / std::sqrt(2 * variance)) + x * gaussian(x, variance) * (7 - u) / 8;
}

FlatFilmMap::FlatFilmMap(double variance, double floor) {
  expects(variance > 0 && floor > 0 && floor < 1,
          "the profile needs a positive variance and a floor between 0 and 1");
  // The slope falls monotonically from its maximum at 0 to its first zero at u = 5 − √10.
  const double first_zero = std::sqrt(variance * (5 - std::sqrt(10.0)));
  const double steepest = profile_slope(0, variance);
  last_distance_ =
      bisect(0, first_zero, [&](double x) { return profile_slope(x, variance) > floor * steepest; });
  last_value_ = flat_film_profile(last_distance_, variance);
  last_slope_ = profile_slope(last_distance_, variance);
  constexpr int n_steps = 1024;  // cubics between them are good to 1e-13 of the width
  steps_per_value_ = n_steps / last_value_;
  table_.resize(n_steps + 1);
  for (int n = 0; n <= n_steps; ++n) {
    const double value = last_value_ * n / n_steps;
    const double x =
        bisect(0, last_distance_, [&](double at) { return flat_film_profile(at, variance) < value; });
    table_[n] = {x, 1 / (steps_per_value_ * profile_slope(x, variance))};
  }
}

double FlatFilmMap::distance(double indicator) const {
  const double value = std::abs(indicator - 0.5);
  double x;
  if (value >= last_value_) {
    x = last_distance_ + (value - last_value_) / last_slope_;
  } else {
    const double place = value * steps_per_value_;
    const int n = std::min(static_cast<int>(place), static_cast<int>(table_.size()) - 2);
    const Knot &a = table_[n], &b = table_[n + 1];
    const double t = place - n, step = b.distance - a.distance;
    // Hermite's cubic, as the chord and what it lacks.
    x = a.distance + t * (step + (1 - t) * ((1 - t) * (a.slope - step) - t * (b.slope - step)));
  }
  return indicator < 0.5 ? -x : x;
}

}  // namespace spume::interface
