#pragma once

#include <string>

namespace spume::state {

/// Something that happened to the foam, a line of events.csv.
struct Event {
  double time;       ///< [s]
  std::string kind;  ///< "rupture", "T1", "bubble lost", "bubble split", "pocket", "equilibrium reached", …
  std::string detail;  ///< in words and numbers
};

}  // namespace spume::state
