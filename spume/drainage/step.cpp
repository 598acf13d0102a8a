#include "spume/drainage/step.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <span>

#include "spume/drainage/constants.hpp"

namespace spume::drainage {
namespace {

void add(const Unknowns& gain, Unknowns& rate) {
  for (std::size_t i = 0; i < gain.film.size(); ++i) rate.film[i] += gain.film[i];
  for (std::size_t i = 0; i < gain.border.size(); ++i) rate.border[i] += gain.border[i];
}

/// right −= factor M k
void subtract_mass(std::span<const double> mass, double factor, std::span<const double> k,
                   std::span<double> right) {
  for (std::size_t i = 0; i < k.size(); ++i) right[i] -= factor * mass[i] * k[i];
}

/// Index of the first value that is not finite and positive, −1 if all are.
int first_not_positive(std::span<const double> values) {
  const auto bad =
      std::find_if(values.begin(), values.end(), [](double v) { return !(v > 0) || !std::isfinite(v); });
  return bad == values.end() ? -1 : static_cast<int>(bad - values.begin());
}

}  // namespace

void Stepper::start(const Unknowns& y, const Unknowns* gain) {
  start_ = y;
  equations_.linearise(start_, initial_rates_);
  if (gain != nullptr) add(*gain, initial_rates_);
}

void Stepper::evaluate_rates(const Unknowns& y, const Unknowns* gain, Unknowns& rate) {
  equations_.rates(y, rate);
  if (gain != nullptr) add(*gain, rate);
}

const Trial& Stepper::attempt(Method method, double dt, const Unknowns* gain) {
  trial_.positive = false;
  trial_.worst = {};
  if (method == Method::Rosenbrock)
    rosenbrock(dt, gain);
  else
    euler(dt, gain);
  return trial_;
}

void Stepper::rosenbrock(double dt, const Unknowns* gain) {
  constexpr double gamma = 1 - 1 / std::numbers::sqrt2;
  if (!equations_.factorise(gamma * dt)) return;
  k1_ = initial_rates_;
  equations_.solve(k1_);
  combine(dt, 1, 0, stage_);
  if (!check_positive(stage_)) return;
  evaluate_rates(stage_, gain, k2_);
  subtract_mass(equations_.film_area(), 2, k1_.film, k2_.film);
  subtract_mass(equations_.border_length(), 2, k1_.border, k2_.border);
  equations_.solve(k2_);
  combine(dt, 1.5, 0.5, trial_.y);
  if (!check_positive(trial_.y)) return;
  trial_.positive = true;
  measure_error(0.5 * dt, 1);
}

void Stepper::euler(double dt, const Unknowns* gain) {
  if (!equations_.factorise(dt)) return;
  k1_ = initial_rates_;
  equations_.solve(k1_);
  combine(dt, 1, 0, trial_.y);
  if (!check_positive(trial_.y)) return;
  evaluate_rates(trial_.y, gain, k2_);
  subtract_mass(equations_.film_area(), 1, k1_.film, k2_.film);
  subtract_mass(equations_.border_length(), 1, k1_.border, k2_.border);
  equations_.solve(k2_);
  trial_.positive = true;
  measure_error(0.5 * dt, 0);
}

void Stepper::combine(double dt, double c1, double c2, Unknowns& to) const {
  const auto combine_part = [&](const std::vector<double>& y, const std::vector<double>& k1,
                                const std::vector<double>& k2, std::vector<double>& sum) {
    sum.resize(y.size());
    for (std::size_t i = 0; i < y.size(); ++i)
      sum[i] = y[i] + dt * (c1 * k1[i] + (c2 != 0 ? c2 * k2[i] : 0.0));
  };
  combine_part(start_.film, k1_.film, k2_.film, to.film);
  combine_part(start_.border, k1_.border, k2_.border, to.border);
}

bool Stepper::check_positive(const Unknowns& y) {
  trial_.worst.film_dof = first_not_positive(y.film);
  trial_.worst.border_unknown = trial_.worst.film_dof < 0 ? first_not_positive(y.border) : -1;
  return trial_.worst.film_dof < 0 && trial_.worst.border_unknown < 0;
}

void Stepper::measure_error(double scale, double c1) {
  trial_.error = 0;
  const auto measure_part = [&](const std::vector<double>& y, const std::vector<double>& k1,
                                const std::vector<double>& k2, const std::vector<double>& y_new, double floor,
                                bool is_film) {
    for (std::size_t i = 0; i < y.size(); ++i) {
      const double change = std::abs(scale * (c1 * k1[i] + k2[i]));
      const double error = std::isfinite(change) ? change / (std::min(y[i], y_new[i]) + floor)
                                                 : std::numeric_limits<double>::infinity();
      if (error <= trial_.error) continue;
      trial_.error = error;
      trial_.worst = is_film ? WorstUnknown{static_cast<int>(i), -1} : WorstUnknown{-1, static_cast<int>(i)};
    }
  };
  measure_part(start_.film, k1_.film, k2_.film, trial_.y.film, half_thickness_floor, true);
  measure_part(start_.border, k1_.border, k2_.border, trial_.y.border, border_area_floor, false);
}

}  // namespace spume::drainage
