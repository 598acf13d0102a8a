#pragma once

#include "spume/state/film_liquid.hpp"

namespace spume::transport {

/// Every rule of transport conserves up to the last digit of its sums; what these digits are short of the
/// total `before` [m³] goes to the fullest film dof. Throws NumericalError where more than 1e-10 of it is
/// off.
void close_ledger(double before, state::FilmLiquid& liquid);

}  // namespace spume::transport
