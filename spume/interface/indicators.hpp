#pragma once

#include <vector>

#include "spume/grid/field.hpp"
#include "spume/grid/grid.hpp"
#include "spume/interface/cell_box.hpp"
#include "spume/interface/curved_triangles.hpp"
#include "spume/mesh/film_mesh.hpp"

namespace spume::interface {

/// Where the indicator of each phase is computed and kept; empty for the outside and for phases without
/// films.
struct PhaseBlocks {
  /// Bounding box of the phase's films, grown by 8 cells, where a smoothed indicator is within 1e-6 of 0 at
  /// s = 2 h², and cut off at walls; all cells for a layer or a tunnel through a periodic box.
  std::vector<CellBox> cells;
  /// The same with more cells, as transforms like it, and not cut off at walls: a room that is periodic in
  /// itself. All cells of the box are a room with its boundaries: a layer may lie on a wall.
  std::vector<CellBox> room;
};

PhaseBlocks blocks_of_phases(const grid::Grid& grid, const mesh::FilmMesh& films, int n_phases);

/// The indicator of each bubble on its cells and on every rank (layout of PhaseField::value), smoothed by
/// smoothing_kernel() of the given variance [m²]. Indicators are 1 inside, 0 outside and ½ on a flat film.
///
/// The flux −n dA of a phase's surface, spread to the faces of the cells by B-splines that are cubic across
/// the face and quadratic along it, is the discrete gradient of (quadratic B-spline ∗ indicator) sampled at
/// cell centres. Its discrete divergence therefore determines the indicator by one Poisson solve; that, the
/// division by the B-spline's transform and the kernel are one factor in Fourier space,
///   ĉ = (div g)^ T(s|θ|²/(2h²)) / (−Σ_d (2 − 2 cos θ_d)/h² Π_d sinc³(θ_d/2)),
/// and the mean of c is the volume of the phase over that of its room. Beyond eight cells the kernel is not
/// felt, so each bubble has a small transform of its own; ranks share the bubbles between them.
/// Triangles are curved: quadratic through corners and midpoints of edges.
/// Collective. The films must be at least four cells away from walls, where mirror images would be felt.
std::vector<std::vector<double>> smoothed_indicators(const grid::Grid& grid, const mesh::FilmMesh& films,
                                                     const std::vector<EdgeMidpoints>& midpoints,
                                                     const PhaseBlocks& blocks, double variance);

}  // namespace spume::interface
