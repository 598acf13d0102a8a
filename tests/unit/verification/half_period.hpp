#pragma once

namespace spume::verification {

/// Time between two zeros of a wave's amplitude, the first after t = 6/ω: late enough for the memory of the
/// start to be small.
template <class Wave>
double half_period(const Wave& wave, double omega) {
  const auto zero_after = [&](double t) {
    const double step = 1e-3 / omega;
    while (wave.amplitude(t) * wave.amplitude(t + step) > 0) t += step;
    const double a = wave.amplitude(t), b = wave.amplitude(t + step);
    return t + step * a / (a - b);
  };
  const double first = zero_after(6 / omega);
  return zero_after(first + 0.1 / omega) - first;
}

}  // namespace spume::verification
