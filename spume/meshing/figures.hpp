#pragma once

#include "spume/mesh/film_mesh.hpp"
#include "spume/mesh/remesh.hpp"
#include "spume/mesh/topology.hpp"

namespace spume::meshing {

/// How good a film mesh is for finite elements, and how near it lies to the films it stands for.
struct MeshFigures {
  int n_triangles = 0;
  int n_nonconforming_edges = 0;  ///< neither inside one lamella nor on a border
  int n_turned = 0;  ///< triangles whose normal opposes that of a triangle beside it in their lamella, or the
                     ///< mean normal of the lamella around their corners
  double smallest_angle_degrees = 0;
  double median_angle_degrees = 0;  ///< of the smallest angles of the triangles
  double share_round = 0;           ///< of triangles whose radius ratio 2 r_in/r_circ exceeds ½
  double smallest_radius_ratio = 0;
  double film_distance = 0;    ///< largest of a vertex from a film it belongs to [m]
  double border_distance = 0;  ///< largest of a vertex from a triple line it belongs to [m]
  int n_unprojected = 0;       ///< pairs of a vertex and its film or border for which no projection was found
  int n_drawn_together = 0;    ///< junctions whose phases have no point in common, as where a reconstruction
                               ///< draws several junctions together: in neither distance
  double drawn_together_distance = 0;  ///< largest of one of those from a film that ends there [m]
};

/// Measures a mesh with at least one triangle; distances are those that `project` moves the vertices by, onto
/// each of their films and each of their borders in turn.
MeshFigures figures_of(const mesh::FilmMesh& films, const mesh::Topology& topology,
                       const mesh::Projection& project);

/// MeshFigures::n_turned alone.
int count_turned(const mesh::FilmMesh& films, const mesh::Topology& topology);

/// 2 r_in / r_circ of a triangle with sides a, b, c: 1 for an equilateral one, 0 where it has no area.
double radius_ratio(double a, double b, double c);

}  // namespace spume::meshing
