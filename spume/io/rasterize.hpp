#pragma once

#include <vector>

#include "spume/grid/box.hpp"
#include "spume/mesh/film_mesh.hpp"

namespace spume::io {

/// The phase that holds the centre of each cell, i fastest, then j, k. Counts the films crossed by the row of
/// cell centres from the lower x face of the box, where the outside is; `n_phases` is one more than the
/// largest phase. Films must not cross the faces of the box. A film that passes exactly through a centre lies
/// beyond it.
std::vector<mesh::Phase> rasterize_phases(const mesh::FilmMesh& films, int n_phases, const grid::Box& box);

/// Distance from the centre of each cell to the nearest film, i fastest, then j, k [m]. Each cell takes the
/// nearest of the triangles that its neighbours have found (closest-point sweeps), starting from the cells
/// around each triangle: exact there, and elsewhere except where the nearest triangle is no neighbour's, by
/// less than a cell. `largest_value` [m] where there are no films.
std::vector<double> rasterize_distance(const mesh::FilmMesh& films, const grid::Box& box,
                                       double largest_value);

}  // namespace spume::io
