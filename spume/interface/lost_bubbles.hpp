#pragma once

#include <vector>

#include "spume/interface/phase_pieces.hpp"
#include "spume/mesh/film_mesh.hpp"
#include "spume/state/phases.hpp"

namespace spume::interface {

/// Takes a bubble out of the mesh: its triangles go to the neighbour with which it shares the most film area
/// (the lowest of equals; the outside if it has no film at all), which also gets its gas, that is, its target
/// volume. The films between the two drop out. Appends a Lost change.
void remove_bubble(mesh::FilmMesh& films, state::Phases& phases, mesh::Phase bubble,
                   std::vector<PhaseChange>& changes);

/// Removes, in the order of ids, every bubble whose target volume, or volume on the mesh, is below
/// `smallest_volume` [m³].
void remove_small_bubbles(mesh::FilmMesh& films, state::Phases& phases, double smallest_volume,
                          std::vector<PhaseChange>& changes);

}  // namespace spume::interface
