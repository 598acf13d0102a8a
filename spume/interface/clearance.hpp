#pragma once

#include <string>

#include "spume/grid/grid.hpp"
#include "spume/mesh/film_mesh.hpp"

namespace spume::interface {

/// Says where a vertex is within four cells of a wall (or not finite); empty when none is. Nearer films would
/// feel the wall in their smoothed indicators. Periodic faces do not matter.
std::string clearance_problem(const grid::Grid& grid, const mesh::FilmMesh& films);
/// The same for any edge of the box, for methods whose films do not continue across periodic faces.
std::string edge_problem(const grid::Grid& grid, const mesh::FilmMesh& films);

}  // namespace spume::interface
