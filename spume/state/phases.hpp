#pragma once

#include <vector>

#include "spume/mesh/phase_set.hpp"

namespace spume::state {

/// The phases by id. Phase 0 is the outside. A bubble that is no more keeps its id with target volume 0.
struct Phases {
  std::vector<double> target_volume{0.0};  ///< [m³]; the entry of the outside is unused
  mesh::Phase above_membrane = 0;          ///< the outside beyond a film across the box; 0: there is none

  int count() const { return static_cast<int>(target_volume.size()); }
  bool alive(mesh::Phase p) const { return p == 0 || target_volume[p] > 0; }
  bool is_bubble(mesh::Phase p) const { return p != 0 && p != above_membrane && alive(p); }
  int n_bubbles() const {
    int n = 0;
    for (mesh::Phase p = 1; p < count(); ++p) n += is_bubble(p);
    return n;
  }
};

}  // namespace spume::state
