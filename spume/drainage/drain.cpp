#include "spume/drainage/drain.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>
#include <utility>

#include "spume/base/contract.hpp"
#include "spume/base/error.hpp"
#include "spume/drainage/constants.hpp"
#include "spume/drainage/crossing.hpp"
#include "spume/drainage/equations.hpp"
#include "spume/drainage/paper_drain.hpp"
#include "spume/drainage/place.hpp"
#include "spume/drainage/step.hpp"

namespace spume::drainage {
namespace {

constexpr int rejections_before_euler = 3;
constexpr int crossing_tries = 5;

void check_input(const state::FilmNetwork& network, const state::Materials& materials,
                 const DrainageParameters& parameters) {
  expects(network.half_thickness.size() == network.topology.film_dof.size() &&
              network.curvature_squared.size() == network.topology.film_dof.size(),
          "one half-thickness and one curvature per film dof");
  expects(static_cast<int>(network.border_area.size()) == network.mesh.n_vertices(),
          "one border area per vertex");
  const auto [rho, mu] = materials.liquid;
  if (!(mu > 0) || !(materials.film.surface_tension >= 0) || !(rho >= 0) ||
      !std::isfinite(norm(materials.gravity)))
    throw InputError(
        "drainage needs a positive viscosity, no negative tension or density, and a finite gravity");
  if (!(parameters.tolerance > 0) || !(parameters.max_step > 0))
    throw InputError("drainage needs a positive tolerance and a positive max_step");
}

void check_state(const state::FilmNetwork& network, const DrainageEquations& equations, const Unknowns& y) {
  for (std::size_t d = 0; d < y.film.size(); ++d)
    if (!(y.film[d] > 0) || !std::isfinite(y.film[d]) || !std::isfinite(network.curvature_squared[d]))
      throw NumericalError("drainage cannot start: " +
                           describe_film_dof(network, static_cast<int>(d), y.film[d]));
  for (std::size_t u = 0; u < y.border.size(); ++u)
    if (!(y.border[u] > 0) || !std::isfinite(y.border[u]))
      throw NumericalError("drainage cannot start: " +
                           describe_border_vertex(network, equations.borders().vertex[u], y.border[u]));
}

/// 0.02 of the shortest time in which a border empties the rim of a film, 3μ r²/(ση), λ = (√3 − π/2) r²;
/// without borders, the time in which some η changes by a fiftieth. `rate` has the lamellae of this rank.
/// Collective.
double first_step(const DrainageEquations& equations, const state::Materials& materials, const Unknowns& y,
                  const Unknowns& rate) {
  const double sigma = materials.film.surface_tension, mu = materials.liquid.viscosity;
  double shortest = std::numeric_limits<double>::infinity();
  for (const SuctionSite& site : equations.sites())
    shortest = std::min(
        shortest, 3 * mu * y.border[site.border_unknown] / (border_shape * sigma * y.film[site.film_dof]));
  if (equations.sites().empty())
    for (std::size_t d = 0; d < y.film.size(); ++d)
      shortest = std::min(shortest, equations.film_area()[d] * y.film[d] / std::abs(rate.film[d]));
  return 0.02 * equations.shares().communicator().min(shortest);
}

/// One drainage stage in progress.
class Stage {
 public:
  Stage(state::FilmNetwork& network, const state::Materials& materials, const DrainageParameters& parameters,
        double threshold, const ThinnestPoint& thinnest, const parallel::Communicator& communicator)
      : network_(network),
        parameters_(parameters),
        threshold_(threshold),
        thinnest_of_(thinnest),
        equations_(network, materials, communicator),
        stepper_(equations_),
        y_(equations_.read(network)) {
    check_state(network, equations_, y_);
    stepper_.start(y_);
    dt_ = first_step(equations_, materials, y_, stepper_.initial_rates());
    shortest_step_ = std::min(1e-9, 1e-4 * dt_);
    limited_by_ = "first step";
    initial_liquid_ = equations_.liquid(y_);
    thinnest_ = thinnest_of_(network_);
  }

  bool ruptured() const { return log_excess(thinnest_) < 0; }
  bool over() const { return elapsed_ >= parameters_.max_time; }

  /// One accepted step, cut at the moment of rupture.
  void advance() {
    const Trial& trial = accepted_step();
    const Moment before{0, log_excess(thinnest_)};
    use(trial.y);
    if (ruptured()) cut_at_rupture(before);
    y_ = std::move(next_);
    elapsed_ = step_ == parameters_.max_time - elapsed_ ? parameters_.max_time : elapsed_ + step_;
    ++n_steps_;
    reported_limit_ = ruptured() ? "rupture" : limited_by_;
    limited_by_ = "error";
    if (!over() && !ruptured()) stepper_.start(y_);
  }

  DrainageProgress progress() const {
    return {elapsed_, step_, n_steps_, n_rejected_, thinnest_, reported_limit_};
  }
  DrainageOutcome outcome(Ending ending) const {
    const double ledger_error = (equations_.liquid(y_) - initial_liquid_) / initial_liquid_;
    return {ending, elapsed_, thinnest_, n_steps_, n_rejected_, ledger_error};
  }

 private:
  /// ln(η/threshold) where it is thinnest; infinite where no point counts.
  double log_excess(const state::ThinPoint& point) const {
    if (point.film_dof < 0 || !(threshold_ > 0)) return std::numeric_limits<double>::infinity();
    return std::log(point.half_thickness / threshold_);
  }

  /// Takes y as the state after the step.
  void use(const Unknowns& y) {
    next_ = y;
    equations_.write(next_, network_);
    thinnest_ = thinnest_of_(network_);
  }

  /// Length of the next attempt: what the error allows, within max_step and the end of the stage.
  double next_attempt() {
    double dt = dt_;
    const double remaining = parameters_.max_time - elapsed_;
    if (dt > parameters_.max_step) {
      dt = parameters_.max_step;
      limited_by_ = "max_step";
    }
    if (dt >= remaining * (1 - 1e-9)) {
      dt = remaining;
      limited_by_ = "end of stage";
    }
    return dt;
  }

  const Trial& accepted_step() {
    for (int rejections = 0;; ++rejections) {
      step_ = next_attempt();
      method_ = rejections < rejections_before_euler ? Method::Rosenbrock : Method::Euler;
      const Trial& trial = stepper_.attempt(method_, step_);
      const double error = trial.error / parameters_.tolerance;
      const double change = trial.positive ? 0.85 / std::sqrt(std::max(error, 1e-12)) : 0.25;
      dt_ = step_ * std::clamp(change, 0.2, 2.0);
      if (trial.positive && error <= 1) return trial;
      ++n_rejected_;
      limited_by_ = trial.positive ? "error" : "positivity";
      if (dt_ < std::max(shortest_step_, 1e-7 * elapsed_)) throw_stalled(trial);
    }
  }

  /// Repeats the accepted step with the length at which the thinnest η falls just below the threshold, so
  /// that the state at rupture is one of the scheme and not an interpolation.
  void cut_at_rupture(Moment before) {
    const double close = 0.1 * std::min(parameters_.tolerance, 0.1);
    const auto aimed = [&](Moment moment) {
      return Moment{moment.since_step, moment.log_excess + 0.5 * close};
    };
    Moment after{step_, log_excess(thinnest_)};
    Unknowns below = next_;
    for (int tries = 0; tries < crossing_tries && after.log_excess < -close; ++tries) {
      if (!std::isfinite(before.log_excess)) break;
      const double length = crossing_time(elapsed_, aimed(before), aimed(after));
      const Trial& trial = stepper_.attempt(method_, length);
      if (!trial.positive) break;
      use(trial.y);
      const Moment middle{length, log_excess(thinnest_)};
      if (middle.log_excess < 0) {
        after = middle;
        below = next_;
      } else {
        before = middle;
      }
    }
    step_ = after.since_step;
    use(below);
  }

  [[noreturn]] void throw_stalled(const Trial& trial) const {
    std::ostringstream message;
    message << "drainage stalled " << elapsed_ << " s after its start: a step of " << step_
            << " s was rejected (" << (trial.positive ? "error too large" : "not positive or not finite")
            << ")";
    if (trial.worst.film_dof >= 0)
      message << ", worst: "
              << describe_film_dof(network_, trial.worst.film_dof, y_.film[trial.worst.film_dof]);
    if (trial.worst.border_unknown >= 0)
      message << ", worst: "
              << describe_border_vertex(network_, equations_.borders().vertex[trial.worst.border_unknown],
                                        y_.border[trial.worst.border_unknown]);
    throw NumericalError(message.str());
  }

  state::FilmNetwork& network_;
  const DrainageParameters parameters_;
  const double threshold_;
  const ThinnestPoint& thinnest_of_;
  DrainageEquations equations_;
  Stepper stepper_;
  Unknowns y_, next_;  ///< before and after the step
  state::ThinPoint thinnest_;
  Method method_ = Method::Rosenbrock;
  double elapsed_ = 0, dt_ = 0, step_ = 0, shortest_step_ = 0,
         initial_liquid_ = 0;  // dt_: what the error allows
  int n_steps_ = 0, n_rejected_ = 0;
  std::string limited_by_, reported_limit_;
};

}  // namespace

DrainageOutcome drain(state::FilmNetwork& network, const state::Materials& materials,
                      const DrainageParameters& parameters, double threshold, const ThinnestPoint& thinnest,
                      const OnStep& on_step, const parallel::Communicator& communicator) {
  check_input(network, materials, parameters);
  if (parameters.scheme == Scheme::Paper)
    return drain_as_published(network, materials, parameters, threshold, thinnest, on_step, communicator);
  Stage stage(network, materials, parameters, threshold, thinnest, communicator);
  while (!stage.ruptured() && !stage.over()) {
    stage.advance();
    const bool go_on = !on_step || on_step(stage.progress(), network);
    if (!go_on && !stage.ruptured()) return stage.outcome(Ending::Stopped);
  }
  return stage.outcome(stage.ruptured() ? Ending::Ruptured : Ending::Drained);
}

}  // namespace spume::drainage
