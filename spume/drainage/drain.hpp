#pragma once

#include <functional>
#include <string>
#include <vector>

#include "spume/parallel/communicator.hpp"
#include "spume/state/film_network.hpp"
#include "spume/state/materials.hpp"
#include "spume/state/thin_point.hpp"

namespace spume::drainage {

enum class Scheme {
  Positive,  ///< second order, adaptive, keeps η and λ positive (equations.hpp, step.hpp)
  Paper,     ///< as published (paper_drain.hpp)
};

struct DrainageParameters {
  Scheme scheme = Scheme::Positive;
  double max_time = 100;    ///< of one drainage stage [s]
  double tolerance = 0.02;  ///< relative error of η and λ a step; the paper's scheme has a fixed step
  double max_step = 10;     ///< [s]
};

enum class Ending { Ruptured, Drained, Stopped };

struct DrainageOutcome {
  Ending ending;
  double elapsed;             ///< [s] since the start of the stage
  state::ThinPoint thinnest;  ///< where it ruptured or would rupture next
  int n_steps, n_rejected;
  double ledger_error;  ///< change of 2Σ∫η + Σ∫λ, relative
};

/// What happens after each accepted step; return false to stop (state is then the one just accepted).
struct DrainageProgress {
  double elapsed, step;  ///< [s]
  int n_steps, n_rejected;
  state::ThinPoint thinnest;
  std::string limited_by;  ///< "error", "max_step", "first step", "rupture", …
};
using OnStep = std::function<bool(const DrainageProgress&, const state::FilmNetwork&)>;
/// The rupture criterion: the thinnest point that counts (rupture/criterion.hpp makes one).
using ThinnestPoint = std::function<state::ThinPoint(const state::FilmNetwork&)>;

/// Drains the films until some η that the criterion sees falls below `threshold` [m] or the time is up.
/// The ranks of `communicator` share the work, lamella by lamella; each has the whole network and ends with
/// the same bits, which do not depend on their number, and calls `thinnest` and `on_step`, which must answer
/// alike on all of them. Throws InputError for materials or parameters that make no sense, NumericalError
/// where η or λ is not positive at the start or no step is accepted, on all ranks together. Collective.
/// A stage is a function of the network at its start, to the bit. It ends otherwise, within the tolerance, if
/// it is cut in two, for the second part begins with a first step and factors of its own; a run that was
/// killed therefore repeats the stage from its start.
DrainageOutcome drain(state::FilmNetwork& network, const state::Materials& materials,
                      const DrainageParameters& parameters, double threshold, const ThinnestPoint& thinnest,
                      const OnStep& on_step,
                      const parallel::Communicator& communicator = parallel::Communicator::self());

}  // namespace spume::drainage
