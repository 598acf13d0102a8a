#pragma once

#include <vector>

#include "spume/mesh/film_mesh.hpp"
#include "spume/mesh/quality.hpp"
#include "spume/mesh/remesh.hpp"
#include "spume/mesh/topology.hpp"
#include "spume/meshing/repair.hpp"

namespace spume::meshing {

/// The mesh for drainage (paper, Sec. 3.3.1): nearly equilateral triangles, uniform or finer towards Plateau
/// borders, where the films' boundary layers are.
struct MeshingParameters {
  double edge = 1.0;                 ///< target edge in the middle of films [h]
  double edge_at_borders = 0;        ///< target edge at Plateau borders [m]; 0: half the boundary layer …
  double coarsest_at_borders = 0.6;  ///< … but not above this [h],
  double finest_at_borders = 0.35;   ///< nor below this [h]
  double layer_width = 0;  ///< of the boundary layer [m], see drainage_layer_width(); 0: as wide as need be
  double edge_at_junctions = 0;        ///< target edge where borders meet [m]; 0: as at borders
  double smallest_edge = 0.15;         ///< target around short borders and in narrow films, at least [h]
  double grading = 0.3;                ///< growth of the target a unit of distance from the border
  int sweeps = 20;                     ///< of moves by forces
  bool one_triangle_a_corner = true;   ///< at junctions, where the corner of the film allows it
  double wanted_angle_degrees = 32;    ///< triangles with smaller angles are repaired where possible
  double smallest_angle_degrees = 20;  ///< wanted; the report says what was reached
};
struct MeshingReport {
  mesh::Quality after;
  mesh::RemeshReport remesh;  ///< collapses, splits and flips of all kinds
  RepairReport repair;
  int n_off = 0;  ///< vertices that could not be put onto their film, border or junction
};

/// Improves a film mesh in place; what its lamellae, borders and junctions are does not change. `h` [m]
/// scales the targets. Edges are split and collapsed to their targets; `sweeps` sweeps of the two force laws
/// (forces.hpp) with steps that invert nothing (moves.hpp), and flips towards Delaunay, make triangles
/// equilateral; the few poor ones left are repaired (repair.hpp). Every vertex is on its film, border or
/// junction by `project` at the end, but for those where that would spoil a triangle. Results depend on the
/// mesh alone, not on ranks.
MeshingReport improve(mesh::FilmMesh& films, const mesh::Projection& project, double h,
                      const MeshingParameters& parameters);

/// Puts the vertices of such a mesh onto films that have moved a little since, but for those where that would
/// spoil a triangle, as at the end of improve(). Gives the number of those.
int follow_films(mesh::FilmMesh& films, const mesh::Projection& project);

/// Width of the layer at a Plateau border in which a film thins [m]: sqrt(η r), where r = sqrt(λ/(√3 − π/2))
/// is the radius of the border (paper, Sec. 5.4). Takes η > 0 [m], λ > 0 [m²].
double drainage_layer_width(double half_thickness, double border_area);

/// k₁² + k₂² at every film dof [1/m²], by a quadric fitted to the lamella's vertices around it.
std::vector<double> curvature_squared(const mesh::FilmMesh& films, const mesh::Topology& topology);

}  // namespace spume::meshing
