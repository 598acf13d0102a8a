#pragma once

#include <vector>

#include "spume/grid/field.hpp"
#include "spume/grid/grid.hpp"
#include "spume/interface/cell_box.hpp"
#include "spume/interface/curved_triangles.hpp"
#include "spume/mesh/film_mesh.hpp"

namespace spume::interface {

/// Which bubbles share a field. Two bubbles have one colour only when their boxes do not overlap.
struct PhaseColours {
  int n_colours = 0;
  std::vector<int> colour;  ///< of each phase; −1 for the outside and for phases without films
  /// Of each phase: bounding box of its films, grown; all cells for a layer or tunnel through a periodic box;
  /// empty where colour is −1.
  std::vector<CellBox> cells;
};

/// Greedy colouring in the order of ids. Boxes are bounding boxes of the phases' triangles grown by 6 cells,
/// where the kernel's tail is below 1e-6.
PhaseColours colour_phases(const grid::Grid& grid, const mesh::FilmMesh& films, int n_phases);

/// The indicators of all bubbles of each colour, smoothed by smoothing_kernel() of the given variance [m²],
/// on all cells and every rank (layout of grid::gather()). Indicators are 1 inside, 0 outside and ½ on a flat
/// film.
///
/// The flux −n dA of a phase's surface, spread to the faces of the cells by B-splines that are cubic across
/// the face and quadratic along it, is the discrete gradient of (quadratic B-spline ∗ indicator) sampled at
/// cell centres. Its discrete divergence therefore determines the indicator by one Poisson solve; that, the
/// division by the B-spline's transform and the kernel are one factor in Fourier (or cosine) space,
///   ĉ = (div g)^ T(s|θ|²/(2h²)) / (−Σ_d (2 − 2 cos θ_d)/h² Π_d sinc³(θ_d/2)),
/// and the mean of c is the volume of the phases over that of the box.
/// Collective. The films must be at least three cells away from walls.
std::vector<std::vector<double>> smoothed_indicators(const grid::Grid& grid, const mesh::FilmMesh& films,
                                                     const std::vector<EdgeMidpoints>& midpoints,
                                                     const PhaseColours& colours, double variance);

}  // namespace spume::interface
