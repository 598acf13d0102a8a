#include "spume/grid/box.hpp"

#include <algorithm>

namespace spume::grid {

bool Box::is_periodic() const {
  return std::all_of(boundary.begin(), boundary.end(), [](Boundary b) { return b == Boundary::Periodic; });
}

Domain Box::domain() const {
  Domain domain{lower, size()};
  for (int d = 0; d < 3; ++d) domain.periodic[d] = boundary[d] == Boundary::Periodic;
  return domain;
}

}  // namespace spume::grid
