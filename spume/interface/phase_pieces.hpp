#pragma once

#include <vector>

#include "spume/interface/potentials.hpp"
#include "spume/interface/reconstruct.hpp"
#include "spume/mesh/film_mesh.hpp"
#include "spume/mesh/topology.hpp"
#include "spume/state/phases.hpp"

namespace spume::interface {

using PhaseChange = ReconstructReport::PhaseChange;

/// A connected set of cells of one phase. Cells are linked along the edges of the Kuhn tetrahedra (steps of 0
/// or 1 along every axis, all of one sign): that is how the contour links them, because a phase that wins at
/// both ends of an edge wins all along it. Only in a cube of two phases, whose film is one piece, does it cut
/// the link along the diagonal of the cube: see torn_bubbles().
struct PhasePiece {
  mesh::Phase phase;
  CellBox cells;  ///< bounding box of its cells as they are numbered in the grid
  std::size_t n_cells;
};

/// A row of cells of one phase and piece: i_begin ≤ i < i_end at (j, k).
struct CellRun {
  int i_begin, i_end, j, k;
  mesh::Phase phase;
  int piece;
};

struct PhasePieces {
  std::vector<CellRun> run;       ///< in the order of cells
  std::vector<PhasePiece> piece;  ///< in the order of their first cell
};

/// Bubbles that the contour has torn though their cells are linked, at a neck thinner than a cell.
struct TornBubbles {
  std::vector<mesh::Phase> phase;
  std::size_t least_cells = 0;  ///< of a piece
};

/// The pieces of all phases; `winner` as of find_winners(). Pieces continue across periodic faces. Links
/// along the diagonals of cubes do not count for torn bubbles, but that what is smaller than a piece stays
/// with one that it is linked to.
PhasePieces find_pieces(const Lattice& lattice, const std::vector<mesh::Phase>& winner,
                        const TornBubbles& torn = {});

/// A closed surface of one phase: lamellae linked by vertices that they share, all by the images nearest to
/// one of them. What spans more than 0.4 of a periodic box is not measured: its volume is infinite.
struct ClosedSurface {
  mesh::Phase phase;
  double volume = 0;  ///< enclosed; negative around a cavity [m³]
  Vec3 lower, upper;  ///< bounding box [m]
  Vec3 start;         ///< a point of it [m]
};
/// The surfaces of the outside, and of the phases that have several: a bubble with one is neither torn nor
/// has specks.
std::vector<ClosedSurface> closed_surfaces(const mesh::FilmMesh& films, const mesh::Topology& topology);

/// The bubbles whose films enclose `smallest_volume` [m³] or more in several closed surfaces. Of surfaces
/// that span more than 0.4 of a periodic box it is not known what they enclose: a bubble that has these alone
/// is taken for whole.
TornBubbles torn_bubbles(double h, const std::vector<ClosedSurface>& surfaces, double smallest_volume);

/// Makes every phase one piece. The largest piece keeps the phase. Another one becomes a new phase when its
/// cells fill at least `smallest_volume` [m³]: a Split of a bubble or a Pocket of the outside, appended to
/// `phases` with target volume 0 until settle_new_phases(). Smaller ones are Absorbed: their phase is lowered
/// there so that neighbours win. With d the distances to the pieces, the new phase has ψ_p − max(0, d_new −
/// d_old) and the old one ψ_p − max(0, d_old − d_new), both unchanged near their own films. Appends to
/// `changes`; gives whether there was anything to do, in which case the winners have changed.
bool separate_pieces(PhasePotentials& potentials, const std::vector<mesh::Phase>& winner,
                     state::Phases& phases, double smallest_volume, std::vector<PhaseChange>& changes,
                     const TornBubbles& torn = {});

/// Gives target volumes to the phases born by changes[first …], from the volumes of their smooth films:
/// pieces of a bubble share its target in proportion to their volumes, pockets get what was measured. Volumes
/// in `changes` follow.
void settle_new_phases(const mesh::FilmMesh& films, const mesh::Topology& topology, state::Phases& phases,
                       std::vector<PhaseChange>& changes, std::size_t first);

/// The contour may leave specks of a phase that hold no cell centre. Of the contour's `surfaces`, lowers the
/// phase around every one of a phase beyond its largest one (of the outside: around every closed surface)
/// that encloses less than `smallest_volume` [m³], where the phase does not win; gives their number. Contour
/// again if it is not 0.
int suppress_specks(PhasePotentials& potentials, const std::vector<mesh::Phase>& winner,
                    const std::vector<ClosedSurface>& surfaces, double smallest_volume);

}  // namespace spume::interface
