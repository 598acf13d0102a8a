#pragma once

#include <vector>

#include "spume/grid/box.hpp"
#include "spume/interface/cell_box.hpp"
#include "spume/interface/potentials.hpp"
#include "spume/mesh/film_mesh.hpp"
#include "spume/mesh/topology.hpp"

namespace spume::viim {

/// Distances are true within this many cells of a film; farther away they are as if it were this far.
inline constexpr double band_cells = 6;

/// The whole foam in two fields on the cells of the box (i fastest, then j, k): the distance φ to the nearest
/// film and the phase χ that the cell is in. The same on every rank.
struct DistanceField {
  grid::Box box;
  std::vector<double> distance;    ///< φ [m]; slightly negative where a film has passed a cell lately
  std::vector<mesh::Phase> phase;  ///< χ
};

/// φ and χ of a film mesh, whose triangles are taken as curved (interface::edge_midpoints()).
/// `phase_of_cell` is χ.
DistanceField distance_to(const mesh::FilmMesh& films, const mesh::Topology& topology, const grid::Box& box,
                          std::vector<mesh::Phase> phase_of_cell);

/// The same, from films that are where `potentials` are equal: the closest point on the mesh is the start for
/// the closest point on the local tricubic of ½(ψ_i − ψ_j), and is itself taken where it lies on a Plateau
/// border or Newton's method fails. χ are the winners of the potentials.
DistanceField distance_to(const mesh::FilmMesh& films, const mesh::Topology& topology,
                          const interface::PhasePotentials& potentials);

/// The signed function of one phase on a block of cells: φ where χ is the phase, −φ elsewhere. It is smooth
/// across films of the phase, so differences may be taken there.
std::vector<double> signed_distance(const DistanceField& field, mesh::Phase phase,
                                    const interface::CellBox& cells);

}  // namespace spume::viim
