#pragma once

#include <vector>

#include "spume/interface/potentials.hpp"

namespace spume::interface {

/// Fields on the grid that follow from the potentials, for output: gathered, i fastest, the same on every
/// rank.
struct DerivedFields {
  std::vector<double>
      distance;  ///< φ = ½(ψ_(1) − ψ_(2)) ≥ 0, distance to the nearest film where it is near [m]
  std::vector<mesh::Phase> phase;  ///< χ, the phase of each cell
};

/// φ and χ of Saye and Sethian (2016), Sec. 2.1, at the centres of all cells. Away from films φ levels off.
DerivedFields derived_fields(const PhasePotentials& potentials);

}  // namespace spume::interface
