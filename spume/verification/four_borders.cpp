#include "spume/verification/four_borders.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <string>

#include "spume/base/error.hpp"
#include "spume/base/stage_times.hpp"
#include "spume/drainage/constants.hpp"
#include "spume/drainage/step.hpp"
#include "spume/fem/triangle_matrices.hpp"

namespace spume::verification {

namespace {

constexpr int n_borders = 4, n_samples = 32;
constexpr Vec3 down{0, 0, -1};

double c1() {
  return drainage::border_tension(1);
}

/// Value and derivatives of a solution at one place and time.
struct Jet {
  double value, by_length, by_length_twice, by_time;
};

/// The cubic a + A l − ½ l² (3 cos t + 2A + B) + ¼ l³ (2 cos t + A + B): values a, b and slopes A, B at l = 0
/// and l = 2 such that the junctions balance.
Jet straight_border(double l, double t) {
  const double a = 2 + std::cos(t), b = 2 - std::cos(t), s = std::sin(t);
  const double slope0 = a * std::sqrt(a) / c1() + 9 * s - 4, slope2 = -b * std::sqrt(b) / c1() - 9 * s + 2;
  const double slope0_t = -1.5 * std::sqrt(a) * s / c1() + 9 * std::cos(t),
               slope2_t = -1.5 * std::sqrt(b) * s / c1() - 9 * std::cos(t);
  const double q = -0.5 * (3 * std::cos(t) + 2 * slope0 + slope2),
               r = 0.25 * (2 * std::cos(t) + slope0 + slope2);
  const double q_t = -0.5 * (-3 * s + 2 * slope0_t + slope2_t), r_t = 0.25 * (-2 * s + slope0_t + slope2_t);
  return {a + l * (slope0 + l * (q + l * r)), slope0 + l * (2 * q + 3 * l * r), 2 * q + 6 * l * r,
          -s + l * (slope0_t + l * (q_t + l * r_t))};
}

Jet solution(int b, double l, double t) {
  if (b == 3) return straight_border(l, t);
  const double c = std::cos(3 * l + t), s = std::sin(3 * l + t);
  Jet jet{2 + c, -3 * s, -9 * c, -s};
  if (b == 1) {
    jet.value += 3 * std::sin(l);
    jet.by_length += 3 * std::cos(l);
    jet.by_length_twice -= 3 * std::sin(l);
  } else if (b == 2) {
    jet.value += 0.5 * std::sin(2 * l);
    jet.by_length += std::cos(2 * l);
    jet.by_length_twice -= 2 * std::sin(2 * l);
  }
  return jet;
}

double border_length(int b) {
  return b == 3 ? 2 : std::numbers::pi;
}

Vec3 place(int b, double l) {
  if (b == 3) return {l - 1, 0, 0};
  const Vec3 bulge = b == 0 ? Vec3{0, 1, 0} : b == 1 ? Vec3{0, -1, 0} : down;
  return Vec3{-std::cos(l), 0, 0} + std::sin(l) * bulge;
}

/// Adds the error of one border at one time to the largest.
void measure(const std::vector<double>& error, double h, BorderError& most) {
  double square = 0;
  const auto mass = fem::segment_mass(h);
  for (std::size_t i = 0; i + 1 < error.size(); ++i)
    square += mass[0][0] * (error[i] * error[i] + error[i + 1] * error[i + 1]) +
              2 * mass[0][1] * error[i] * error[i + 1];
  for (double e : error) most.largest = std::max(most.largest, std::abs(e));
  most.norm = std::max(most.norm, std::sqrt(square));
}

/// Nodal values of one border.
using NodeValue = std::function<double(int border, int node)>;

void measure_all(int n, double t, const NodeValue& value, BorderError& most) {
  std::vector<double> error(n + 1);
  for (int b = 0; b < n_borders; ++b) {
    const double h = border_length(b) / n;
    for (int i = 0; i <= n; ++i) error[i] = value(b, i) - exact_border_area(b, i * h, t);
    measure(error, h, most);
  }
}

std::vector<std::vector<double>> sample(int n, const NodeValue& value) {
  std::vector<std::vector<double>> all(n_borders, std::vector<double>(n + 1));
  for (int b = 0; b < n_borders; ++b)
    for (int i = 0; i <= n; ++i) all[b][i] = value(b, i);
  return all;
}

/// Fields at the end of each step: its number and the nodal values; and the processor time of the step
/// without its source [s].
using AfterStep = std::function<void(int step, const NodeValue&, double seconds)>;
/// S or λ(t = 0) on border b at arc length l and time t.
using Given = std::function<double(int b, double l, double t)>;

void run_published(int n, double dt, int steps, const Given& initial, const Given& source,
                   const AfterStep& after) {
  drainage::PaperBorders borders(four_borders(n), four_borders_materials());
  const auto offset = borders.offset();
  std::vector<double> lambda(borders.n_nodes()), s(lambda.size()), load(lambda.size());
  const auto fill = [&](const Given& given, double t, std::vector<double>& field) {
    for (int b = 0; b < n_borders; ++b)
      for (int i = 0; i <= n; ++i) field[offset[b] + i] = given(b, i * border_length(b) / n, t);
  };
  fill(initial, 0, lambda);
  for (int step = 1; step <= steps; ++step) {
    std::fill(load.begin(), load.end(), 0.0);
    if (source) {
      fill(source, (step - 1) * dt, s);
      borders.integrate(s, load);
    }
    const double begun = processor_time();
    if (borders.advance(dt, load, lambda))
      throw NumericalError("the published border scheme failed in step " + std::to_string(step));
    after(
        step, [&](int b, int i) { return lambda[offset[b] + i]; }, processor_time() - begun);
    borders.project(lambda);
  }
}

void run_positive(int n, double dt, int steps, const Given& initial, const Given& source,
                  const AfterStep& after) {
  SharedBorders shared = share_junctions(four_borders(n));
  const auto& unknown = shared.unknown;
  drainage::DrainageEquations equations(std::move(shared.network), four_borders_materials());
  drainage::Unknowns y{{}, std::vector<double>(equations.border_length().size())};
  for (int b = 0; b < n_borders; ++b)
    for (int i = 0; i <= n; ++i) y.border[unknown[b][i]] = initial(b, i * border_length(b) / n, 0);
  drainage::Unknowns first_gain, second_gain;
  const auto integrate_source = [&](double t, drainage::Unknowns& gain) {
    gain.border.assign(y.border.size(), 0.0);
    for (int b = 0; b < n_borders && source; ++b)
      for (int i = 0; i <= n; ++i) {
        const double h = border_length(b) / n;
        gain.border[unknown[b][i]] += (i == 0 || i == n ? 0.5 : 1.0) * h * source(b, i * h, t);
      }
  };
  drainage::Stepper stepper(equations);
  for (int step = 1; step <= steps; ++step) {
    integrate_source((step - 1 + drainage::first_gain) * dt, first_gain);
    integrate_source((step - 1 + drainage::second_gain) * dt, second_gain);
    const double begun = processor_time();
    stepper.start(y, &first_gain);
    const drainage::Trial& trial = stepper.attempt(drainage::Method::Rosenbrock, dt, &second_gain);
    if (!trial.positive) throw NumericalError("a border ran dry in step " + std::to_string(step));
    y = trial.y;
    after(
        step, [&](int b, int i) { return y.border[unknown[b][i]]; }, processor_time() - begun);
  }
}

using Run = decltype(run_published);

BorderError error_of(Run& run, int n, int steps) {
  BorderError most;
  const double dt = 1.0 / steps;
  run(n, dt, steps, exact_border_area, exact_border_source,
      [&](int step, const NodeValue& value, double seconds) {
        measure_all(n, step * dt, value, most);
        most.seconds += seconds;
      });
  return most;
}

BorderHistory history_of(Run& run, int n, int steps) {
  if (steps % n_samples != 0) throw InputError("a run of Table 4 needs a multiple of 32 steps");
  BorderHistory history;
  run(
      n, 10.0 / steps, steps, [](int, double, double) { return 1.0; }, {},
      [&](int step, const NodeValue& value, double) {
        if (step % (steps / n_samples) == 0) history.push_back(sample(n, value));
      });
  return history;
}

}  // namespace

state::Materials four_borders_materials() {
  return {.gas = {}, .liquid = {1, 1}, .film = {1}, .gravity = down};
}

drainage::BorderCurves four_borders(int n) {
  drainage::BorderCurves borders;
  borders.junction.resize(2);
  for (int b = 0; b < n_borders; ++b) {
    drainage::BorderCurve curve;
    for (int e = 0; e < n; ++e) {
      const double h = border_length(b) / n;
      const Vec3 edge = place(b, (e + 1) * h) - place(b, e * h);
      curve.length.push_back(norm(edge));
      curve.descent.push_back(dot(down, edge));
    }
    borders.curve.push_back(curve);
    borders.junction[0].push_back({b, false});
    borders.junction[1].push_back({b, true});
  }
  return borders;
}

SharedBorders share_junctions(const drainage::BorderCurves& borders) {
  SharedBorders shared;
  int n_unknowns = static_cast<int>(borders.junction.size());
  for (const auto& curve : borders.curve) shared.unknown.emplace_back(curve.n_nodes(), -1);
  for (std::size_t j = 0; j < borders.junction.size(); ++j)
    for (const auto& [c, at_end] : borders.junction[j])
      (at_end ? shared.unknown[c].back() : shared.unknown[c].front()) = static_cast<int>(j);
  for (auto& nodes : shared.unknown)
    for (int& u : nodes)
      if (u < 0) u = n_unknowns++;
  shared.network.length.assign(n_unknowns, 0.0);
  for (int u = 0; u < n_unknowns; ++u) shared.network.vertex.push_back(u);
  for (std::size_t c = 0; c < borders.curve.size(); ++c)
    for (int e = 0; e < borders.curve[c].n_edges(); ++e) {
      const double h = borders.curve[c].length[e];
      const std::array<int, 2> ends = {shared.unknown[c][e], shared.unknown[c][e + 1]};
      shared.network.link.push_back({ends, h, borders.curve[c].descent[e]});
      for (int u : ends) shared.network.length[u] += fem::lumped_segment_mass(h);
    }
  return shared;
}

double exact_border_area(int b, double l, double t) {
  return solution(b, l, t).value;
}

double exact_border_source(int b, double l, double t) {
  const auto [value, by_length, by_length_twice, by_time] = solution(b, l, t);
  const double root = std::sqrt(value);
  const double g = b == 2 ? std::cos(l) : 0, g_by_length = b == 2 ? -std::sin(l) : 0;
  const double divergence = -c1() * (0.5 * by_length * by_length / root + root * by_length_twice) +
                            2 * value * by_length * g + value * value * g_by_length;
  return by_time + drainage::border_flow * divergence;
}

BorderError published_border_error(int n, int steps) {
  return error_of(run_published, n, steps);
}
BorderError positive_border_error(int n, int steps) {
  return error_of(run_positive, n, steps);
}
std::vector<std::vector<double>> positive_border_end(int n, int steps) {
  std::vector<std::vector<double>> end;
  run_positive(n, 1.0 / steps, steps, exact_border_area, exact_border_source,
               [&](int step, const NodeValue& value, double) {
                 if (step == steps) end = sample(n, value);
               });
  return end;
}
BorderHistory published_border_history(int n, int steps) {
  return history_of(run_published, n, steps);
}
BorderHistory positive_border_history(int n, int steps) {
  return history_of(run_positive, n, steps);
}

std::vector<double> border_liquid(const BorderHistory& history) {
  const drainage::PaperBorders borders(four_borders(static_cast<int>(history.front().front().size()) - 1),
                                       four_borders_materials());
  std::vector<double> liquid;
  for (const auto& fields : history) {
    std::vector<double> lambda;
    for (const auto& nodes : fields) lambda.insert(lambda.end(), nodes.begin(), nodes.end());
    liquid.push_back(borders.liquid(lambda));
  }
  return liquid;
}

BorderError border_difference(const BorderHistory& coarse, const BorderHistory& fine) {
  BorderError most;
  for (std::size_t s = 0; s < coarse.size(); ++s)
    for (int b = 0; b < n_borders; ++b) {
      const auto& nodes = coarse[s][b];
      std::vector<double> difference(nodes.size());
      for (std::size_t i = 0; i < nodes.size(); ++i) difference[i] = nodes[i] - fine[s][b][2 * i];
      measure(difference, border_length(b) / static_cast<double>(nodes.size() - 1), most);
    }
  return most;
}

}  // namespace spume::verification
