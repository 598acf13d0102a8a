#pragma once

#include <vector>

#include "spume/mesh/film_mesh.hpp"
#include "spume/mesh/topology.hpp"
#include "spume/state/phases.hpp"

namespace spume::interface {

/// Area of the smooth films that a mesh stands for, at the target volumes [m²]; every film once.
///
/// Flat triangles that enclose the right volumes have too much area, by about ℓ²/(20 R²) for edges ℓ on films
/// of radius R: 8e-4 at R = 8 h. Here area and volumes are those of the curved triangles of edge_midpoints():
/// A_c = (4 A_4 − A_1)/3 from flat and from four sub-triangles each, V_c alike. These bulge out of the mesh
/// and enclose too much, so the area is taken back to the targets to first order with the film pressures P_i
/// a unit of tension,
///   A = A_c − Σ_i P_i (V_c,i − V_i).
/// For meshes in or near equilibrium; then fourth order in the interior of films.
double smooth_film_area(const mesh::FilmMesh& films, const mesh::Topology& topology,
                        const state::Phases& phases);

/// Volumes that the curved triangles above enclose, V_c of every phase [m³]; indexed by phase.
std::vector<double> smooth_phase_volumes(const mesh::FilmMesh& films, const mesh::Topology& topology,
                                         int n_phases);

}  // namespace spume::interface
