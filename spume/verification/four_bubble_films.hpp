#pragma once

#include "spume/mesh/film_mesh.hpp"
#include "spume/state/film_network.hpp"
#include "spume/verification/refine_films.hpp"

namespace spume::verification {

/// The films of the exact cluster of four equal bubbles, phases 1 to 4, the fourth on top: the spheres of
/// `radius` [m] whose centres are the corners of a regular tetrahedron of that edge, cut by the planes
/// between them, its middle at the origin. Edges are about as long as `spacing` [m], and each corner of a
/// film is one triangle.
mesh::FilmMesh four_bubble_films(double radius, double spacing);

/// Puts middles of edges of these films onto their planes, spheres and circles.
Middle four_bubble_middle(double radius);

/// The foam of the paper's Fig. 15 on such films: half-thickness 5 μm, borders of 0.05 mm², k of spheres
/// outside and of planes inside.
state::FilmNetwork four_bubble_network(mesh::FilmMesh films, double radius);

}  // namespace spume::verification
