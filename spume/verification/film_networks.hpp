#pragma once

#include <span>
#include <vector>

#include "spume/state/film_network.hpp"

namespace spume::verification {

/// A network on a mesh: η and λ the same everywhere, k = 0.
state::FilmNetwork uniform_network(mesh::FilmMesh mesh, double half_thickness, double border_area);

/// Adds the triangles between two rows of vertices that run alongside each other, each time the one with the
/// shorter new edge, the first and the last along `far`, so that a corner there is one triangle. A row may be
/// a single vertex. Normals by the right-hand rule over (near, far, next far) point from p into q.
void add_band(mesh::FilmMesh& mesh, std::span<const int> near, std::span<const int> far, mesh::Phase p,
              mesh::Phase q);

/// A flat film [0, width] × [0, length] in the plane z = 0 between phases 0 and 1, cut in n × m rectangles
/// and these in right triangles. Its edges have one triangle each: nothing flows through them.
mesh::FilmMesh rectangle(double width, double length, int n, int m);

/// A sphere about the origin between phases 0 and 1: the faces of an icosahedron cut in `frequency`²
/// triangles each and projected. The axis z goes through the middles of two faces; frequency must be a
/// multiple of three, and then vertices with six alike triangles stand there.
mesh::FilmMesh geodesic_sphere(double radius, int frequency);

/// An open tube about the axis z between phases 0 and 1, 0 ≤ z ≤ length, of m rings of n vertices and more.
mesh::FilmMesh tube(double radius, double length, int n, int m);

/// Three flat strips that meet at 120° on one straight border along z. `distances` from the border and
/// `heights` along it increase from 0; the far edges let nothing through, like the middle of a film. Phases
/// 1, 2, 3.
mesh::FilmMesh three_strips(std::span<const double> distances, std::span<const double> heights);

/// Six flat films that meet at the origin, cut at `rows` × spacing from it along their four borders: one
/// junction, one triangle in each film corner, edges about as long as the spacing. Phases 1 to 4.
mesh::FilmMesh tetrahedral_corner(double spacing, int rows);

}  // namespace spume::verification
