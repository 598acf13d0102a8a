#include "spume/grid/box.hpp"

#include <algorithm>

namespace spume::grid {

bool Box::is_periodic() const {
  return std::all_of(boundary.begin(), boundary.end(), [](Boundary b) { return b == Boundary::Periodic; });
}

}  // namespace spume::grid
