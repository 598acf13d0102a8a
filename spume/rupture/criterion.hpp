#pragma once

#include <array>
#include <functional>
#include <vector>

#include "spume/state/film_network.hpp"
#include "spume/state/thin_point.hpp"

namespace spume::rupture {

enum class Criterion {
  Film,  ///< border vertices close to a junction do not count: the corner value measures the mesh
  Node,  ///< the paper's minimum over all nodes
};
enum class Fate {
  Redistribute,  ///< the liquid of the torn film goes to its Plateau borders and from there into the
                 ///< neighbours (paper, Sec. 3.4)
  Spray,         ///< it is lost to the ambient gas and booked in its own column
};

struct RuptureParameters {
  double threshold = 1e-7;  ///< half-thickness η at which a lamella ruptures [m]
  Criterion criterion = Criterion::Film;
  Fate liquid = Fate::Redistribute;
  std::vector<std::array<int, 2>> protect;  ///< pairs of phases whose films never rupture
  double corner_radius =
      1.5e-4;  ///< with Criterion::Film: border vertices this near to a junction do not count [m]
};

/// The thinnest film dof that counts under the criterion. Lamellae smaller than `smallest_area` [m²] do not
/// count: fragments left by a T1 have no thickness to speak of. Protected pairs never count.
state::ThinPoint thinnest_point(const state::FilmNetwork& network, const RuptureParameters& parameters,
                                double smallest_area);

}  // namespace spume::rupture
