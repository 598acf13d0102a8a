#include "spume/interface/derived_fields.hpp"

#include <utility>

namespace spume::interface {

DerivedFields derived_fields(const PhasePotentials& potentials) {
  Winners winners = find_winners(potentials);
  for (std::size_t n = 0; n < winners.first.size(); ++n)
    winners.first[n] = 0.5 * (winners.first[n] - winners.second[n]);
  return {std::move(winners.first), std::move(winners.phase)};
}

}  // namespace spume::interface
