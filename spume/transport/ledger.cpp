#include "spume/transport/ledger.hpp"

#include <algorithm>
#include <cmath>

#include "spume/base/error.hpp"

namespace spume::transport {

void close_ledger(double before, state::FilmLiquid& liquid) {
  const double error = before - liquid.total();
  if (!(std::abs(error) <= 1e-10 * before))
    throw NumericalError("the liquid of the films was not conserved when they moved or got another mesh");
  const auto fullest = std::max_element(liquid.lamella_volume.begin(), liquid.lamella_volume.end());
  if (fullest != liquid.lamella_volume.end() && *fullest + error >= 0) *fullest += error;
}

}  // namespace spume::transport
