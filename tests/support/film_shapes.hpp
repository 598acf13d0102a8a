#pragma once

#include "spume/mesh/film_mesh.hpp"

/// Foams in equilibrium whose shape is known exactly, as meshes with all vertices on the exact surfaces.
namespace spume::shapes {

/// A sphere of phase `inside` in the outside: an icosahedron whose edges are halved `subdivisions` times.
/// 20·4^subdivisions triangles; the edges are about 1.05 to 1.24 radius / 2^subdivisions long.
mesh::FilmMesh sphere(const Vec3& centre, double radius, int subdivisions, mesh::Phase inside);

/// Two equal bubbles: spherical caps of the given radius around (∓radius/2, 0, 0), bubble 1 at x < 0 and
/// bubble 2 at x > 0, and a flat septum in x = 0. The ring has radius √3/2 radius and 6n edges; all edges are
/// about 0.9 radius / n. Each volume is 9π/8 radius³, the film area 27π/4 radius².
mesh::FilmMesh double_bubble(double radius, int n);
/// The nearest point of the film (two phases) or ring (three phases) of that double bubble.
Vec3 on_double_bubble(double radius, const Vec3& x, const mesh::PhaseSet& phases);

/// Four equal bubbles around the origin with one junction inside and four outside, ten lamellae (six of them
/// flat) and ten borders (four of them straight). The outer films have the given radius and are centred on
/// the corners of a regular tetrahedron of edge `radius`: spheres at that distance cross at 60 degrees, as in
/// the double bubble. Borders have n edges each. The straight ones are four_bubble_border × radius long.
mesh::FilmMesh four_bubbles(double radius, int n);
inline constexpr double four_bubble_border =
    1.0206207261596576;                                    // √(25/24): from the centre to an outer junction
inline constexpr double four_bubble_area = 33.499028379;   // of all films, for radius 1
inline constexpr double four_bubble_volume = 2.791585698;  // of each bubble, for radius 1
/// The nearest point of the film, border or junction where the phases of that cluster meet.
Vec3 on_four_bubbles(double radius, const Vec3& x, const mesh::PhaseSet& phases);

/// A ball cut into three bubbles by the planes x = ∓width/2: bubble 1 at x < 0, the slice 2, bubble 3. The
/// outer film of the slice is a strip between two closed borders. Edges are about `edge` long.
mesh::FilmMesh sliced_ball(double radius, double width, double edge);
/// The nearest point of the film or border where the phases of that ball meet.
Vec3 on_sliced_ball(double radius, double width, const Vec3& x, const mesh::PhaseSet& phases);

/// Puts a vertex on the edge between two vertices, at a fraction of the way from `a` to `b`, in all triangles
/// there. Gives the vertex.
int split_edge(mesh::FilmMesh& mesh, int a, int b, double fraction);

/// V − E + F of the boundary of a phase.
int euler_characteristic(const mesh::FilmMesh& mesh, mesh::Phase phase);

}  // namespace spume::shapes
