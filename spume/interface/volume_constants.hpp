#pragma once

#include "spume/interface/potentials.hpp"
#include "spume/mesh/film_mesh.hpp"
#include "spume/state/phases.hpp"

namespace spume::interface {

/// Raises the potential of each bubble by a constant c_i so that its volume comes to its target. A film of i
/// and j moves by (c_i − c_j)/2, so to first order Σ_j A_ij (c_i − c_j)/2 = V_i^target − V_i: a graph
/// Laplacian of film areas. In a group of phases linked by films the lowest one stays (the outside in its
/// own). No constant exceeds `largest` [m], because bubbles near the size of a cell do not follow the linear
/// law. `films` lie on the films of the potentials.
void raise_to_volumes(PhasePotentials& potentials, const mesh::FilmMesh& films, const state::Phases& phases,
                      double largest);

}  // namespace spume::interface
