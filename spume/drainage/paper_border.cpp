#include "spume/drainage/paper_border.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "spume/base/error.hpp"
#include "spume/drainage/constants.hpp"
#include "spume/fem/triangle_matrices.hpp"

namespace spume::drainage {
namespace {

/// Mean of √λ over an edge on which λ is linear between a and b.
double mean_root(double a, double b) {
  const double p = std::sqrt(a), q = std::sqrt(b);
  return 2.0 / 3.0 * (a + p * q + b) / (p + q);
}

/// Node after edge e.
int next_node(const BorderCurve& curve, int e) {
  return e + 1 == curve.n_nodes() ? 0 : e + 1;
}

/// The root of a function that falls from f(low) ≥ 0 to f(high) ≤ 0: Newton's method, halving where it leaves
/// the bracket.
template <class Function>
double bracketed_root(Function f, double low, double high) {
  double z = high;
  for (int n = 0; n < 200 && low < high; ++n) {
    const auto [value, slope] = f(z);
    (value > 0 ? low : high) = z;
    double next = z - value / slope;
    if (!(next > low && next < high)) next = 0.5 * (low + high);
    if (std::abs(next - z) <= 1e-16 * z) break;
    z = next;
  }
  return z;
}

}  // namespace

double junction_slope(const JunctionArm& arm, double lambda0) {
  const auto [h0, h1, lambda1, lambda2, gravity] = arm;
  return (lambda1 - lambda0) / h0 + (h1 * (lambda1 - lambda0) + h0 * (lambda1 - lambda2)) / (h1 * (h0 + h1));
}

std::optional<double> junction_area(std::span<const JunctionArm> arms, const state::Materials& materials) {
  const double c = border_tension(materials.film.surface_tension);
  double a = 0, b = 0, d = 0;
  for (const JunctionArm& arm : arms) {
    a += junction_slope(arm, 0);
    b += 1 / arm.h0 + 1 / (arm.h0 + arm.h1);
    d += materials.liquid.density * arm.gravity;
  }
  if (!(a > 0) || !(c > 0) || !std::isfinite(a)) return {};
  const auto f = [&](double z) {
    return std::pair{c * (a - b * z * z) - d * z * z * z, -2 * b * c * z - 3 * d * z * z};
  };
  const double level = std::sqrt(a / b);  // the root without gravity, where f is −d z³
  if (d >= 0) {
    const double z = bracketed_root(f, 0, level);
    return z * z;
  }
  const double lowest = -2 * b * c / (3 * d);  // f falls up to here and rises beyond
  if (!(lowest > level) || f(lowest).first > 0) return {};
  const double z = bracketed_root(f, level, lowest);
  return z * z;
}

double junction_flux(const JunctionArm& arm, double lambda0, const state::Materials& materials) {
  const double c1 = border_tension(materials.film.surface_tension);
  return c1 * std::sqrt(lambda0) * junction_slope(arm, lambda0) -
         lambda0 * lambda0 * materials.liquid.density * arm.gravity;
}

PaperBorders::PaperBorders(BorderCurves borders, const state::Materials& materials)
    : borders_(std::move(borders)), materials_(materials), offset_{0} {
  for (const BorderCurve& curve : borders_.curve) offset_.push_back(offset_.back() + curve.n_nodes());
  for (const auto& tips : borders_.junction)
    for (const BorderTip& tip : tips)
      if (borders_.curve[tip.curve].n_edges() < 2)
        throw InputError(
            "the published drainage scheme needs two edges of every Plateau border at a junction; use a "
            "finer mesh or drainage.scheme = \"positive\"");
  tip_flux_.assign(n_nodes(), 0.0);
}

void PaperBorders::integrate(std::span<const double> source, std::span<double> load) const {
  for (std::size_t c = 0; c < borders_.curve.size(); ++c) {
    const BorderCurve& curve = borders_.curve[c];
    for (int e = 0; e < curve.n_edges(); ++e) {
      const int i = offset_[c] + e, j = offset_[c] + next_node(curve, e);
      const auto mass = fem::segment_mass(curve.length[e]);
      load[i] += mass[0][0] * source[i] + mass[0][1] * source[j];
      load[j] += mass[1][0] * source[i] + mass[1][1] * source[j];
    }
  }
}

double PaperBorders::liquid(std::span<const double> lambda) const {
  long double sum = 0;  // so that what the ledger shows is the scheme and not the summation
  for (std::size_t c = 0; c < borders_.curve.size(); ++c) {
    const BorderCurve& curve = borders_.curve[c];
    for (int e = 0; e < curve.n_edges(); ++e)
      sum += 0.5L * curve.length[e] *
             (static_cast<long double>(lambda[offset_[c] + e]) + lambda[offset_[c] + next_node(curve, e)]);
  }
  return static_cast<double>(sum);
}

int PaperBorders::tip_node(const BorderTip& tip) const {
  return tip.at_end ? offset_[tip.curve + 1] - 1 : offset_[tip.curve];
}

JunctionArm PaperBorders::arm(const BorderTip& tip, std::span<const double> lambda) const {
  const BorderCurve& curve = borders_.curve[tip.curve];
  const int n = curve.n_edges(), node = tip_node(tip), away = tip.at_end ? -1 : 1;
  const int e0 = tip.at_end ? n - 1 : 0, e1 = tip.at_end ? n - 2 : 1;
  const double h0 = curve.length[e0], h1 = curve.length[e1];
  const double d0 = away * curve.descent[e0], d1 = away * curve.descent[e1];
  return {h0, h1, lambda[node + away], lambda[node + 2 * away],
          d0 / h0 + (h1 * d0 - h0 * d1) / (h1 * (h0 + h1))};
}

bool PaperBorders::find_junction_fluxes(std::span<const double> lambda, BorderFault& fault) {
  for (std::size_t j = 0; j < borders_.junction.size(); ++j) {
    arms_.clear();
    for (const BorderTip& tip : borders_.junction[j]) arms_.push_back(arm(tip, lambda));
    const auto lambda0 = junction_area(arms_, materials_);
    if (!lambda0) {
      fault.junction = static_cast<int>(j);
      return false;
    }
    for (std::size_t n = 0; n < arms_.size(); ++n)
      tip_flux_[tip_node(borders_.junction[j][n])] =
          border_flow / materials_.liquid.viscosity * junction_flux(arms_[n], *lambda0, materials_);
  }
  return true;
}

void PaperBorders::advance_curve(int c, double dt, std::span<const double> load, std::span<double> lambda) {
  const BorderCurve& curve = borders_.curve[c];
  const double mobility = border_flow / materials_.liquid.viscosity;  // C_Δ/μ
  const double c1 = border_tension(materials_.film.surface_tension);
  const double alpha = 2 * std::sqrt(*std::max_element(lambda.begin(), lambda.end()));
  matrix_.reset(curve.n_nodes(), curve.closed);
  change_.resize(curve.n_nodes());
  for (int i = 0; i < curve.n_nodes(); ++i) change_[i] = dt * (load[i] - tip_flux_[offset_[c] + i]);
  for (int e = 0; e < curve.n_edges(); ++e) {
    const int i = e, j = next_node(curve, e);
    const double a = lambda[i], b = lambda[j], h = curve.length[e];
    const double drive = -c1 * mean_root(a, b) * (b - a) / h +
                         (a * a + a * b + b * b) / 3 * materials_.liquid.density * curve.descent[e] / h;
    change_[i] -= dt * mobility * drive;
    change_[j] += dt * mobility * drive;
    const auto mass = fem::segment_mass(h);
    const auto stiffness = fem::segment_stiffness(h);
    const double damping = dt * mobility * c1 * alpha;
    matrix_.diagonal[i] += mass[0][0] + damping * stiffness[0][0];
    matrix_.diagonal[j] += mass[1][1] + damping * stiffness[1][1];
    matrix_.off[e] += mass[0][1] + damping * stiffness[0][1];
  }
  matrix_.solve(change_);
  for (int i = 0; i < curve.n_nodes(); ++i) lambda[i] += change_[i];
}

std::optional<BorderFault> PaperBorders::advance(double dt, std::span<const double> load,
                                                 std::span<double> lambda) {
  BorderFault fault;
  if (!find_junction_fluxes(lambda, fault)) return fault;
  for (std::size_t c = 0; c < borders_.curve.size(); ++c) {
    const auto size = static_cast<std::size_t>(borders_.curve[c].n_nodes());
    const auto own = lambda.subspan(offset_[c], size);
    advance_curve(static_cast<int>(c), dt, load.subspan(offset_[c], size), own);
    // The lowest, or one that is not a number.
    const auto worst = std::min_element(
        own.begin(), own.end(), [](double v, double w) { return std::isnan(v) ? !std::isnan(w) : v < w; });
    if (!(*worst > 0) || !std::isfinite(*worst))
      return BorderFault{-1, static_cast<int>(c), static_cast<int>(worst - own.begin()), *worst};
  }
  return {};
}

void PaperBorders::project(std::span<double> lambda) const {
  for (const auto& tips : borders_.junction) {
    double liquid = 0, length = 0;
    for (const BorderTip& tip : tips) {
      const BorderCurve& curve = borders_.curve[tip.curve];
      const double h0 = tip.at_end ? curve.length.back() : curve.length.front();
      liquid += h0 * lambda[tip_node(tip)];
      length += h0;
    }
    for (const BorderTip& tip : tips) lambda[tip_node(tip)] = liquid / length;
  }
}

}  // namespace spume::drainage
