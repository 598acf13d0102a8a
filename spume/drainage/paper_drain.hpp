#pragma once

#include "spume/drainage/drain.hpp"

namespace spume::drainage {

/// drain() by the paper's own schemes (Sec. 3.3): PaperLamella and PaperBorders side by side, tied together
/// by the suction at the beginning of each step, with one fixed step: at most
///   2 h₀²/D, D = (C_Δ/μ) C₁ λ^{1/2}, and h₀/(4 C_Δ λρg/μ) of the edges at junctions, whose fluxes are
///   explicit, a fifth of the time in which the suction would empty a rim node,
/// and max_step. Liquid is conserved to round-off; positivity is not assured at any step. Throws
/// NumericalError that says where and when some η or λ is not positive any more, or a junction has no λ;
/// where several lamellae fail in one step, which of them is told may depend on the number of ranks. The
/// ranks share the lamellae as in drain(). Collective.
DrainageOutcome drain_as_published(state::FilmNetwork& network, const state::Materials& materials,
                                   const DrainageParameters& parameters, double threshold,
                                   const ThinnestPoint& thinnest, const OnStep& on_step,
                                   const parallel::Communicator& communicator);

}  // namespace spume::drainage
