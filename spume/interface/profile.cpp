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
  const double last_distance =
      bisect(0, first_zero, [&](double x) { return profile_slope(x, variance) > floor * steepest; });
  const double last_value = flat_film_profile(last_distance, variance);
  steps_per_value_ = n_steps / last_value;
  const auto distance_at = [&](int n) {
    const double value = last_value * n / n_steps;
    return bisect(0, last_distance, [&](double at) { return flat_film_profile(at, variance) < value; });
  };
  const auto slope_at = [&](double x) { return 1 / (steps_per_value_ * profile_slope(x, variance)); };
  double x = distance_at(0);
  for (int n = 0; n < n_steps; ++n) {
    const double next = distance_at(n + 1), chord = next - x;
    piece_.push_back({x, chord, slope_at(x) - chord, slope_at(next) - chord});
    x = next;
  }
  piece_.push_back({x, slope_at(x), 0, 0});
}

inline double FlatFilmMap::distance_of(double indicator, double steps_per_value, const Piece* pieces) {
  const double place = std::abs(indicator - 0.5) * steps_per_value;
  const int n = std::min(static_cast<int>(place), n_steps);
  const Piece& p = pieces[n];
  const double t = place - n;
  const double x = p.start + t * (p.chord + (1 - t) * ((1 - t) * p.excess_at_start - t * p.excess_at_end));
  return std::copysign(x, indicator - 0.5);
}

double FlatFilmMap::distance(double indicator) const {
  return distance_of(indicator, steps_per_value_, piece_.data());
}

void FlatFilmMap::to_distances(std::span<double> indicators) const {
  const double steps_per_value = steps_per_value_;
  const Piece* pieces = piece_.data();
#pragma GCC ivdep
  for (double& value : indicators) value = distance_of(value, steps_per_value, pieces);
}

}  // namespace spume::interface
