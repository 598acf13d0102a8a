#pragma once

#include <span>

#include "spume/meshing/star_mesh.hpp"

namespace spume::meshing {

/// Where the forces of the mesh want a vertex to go [m], from where it is; `target` holds the wanted edge
/// lengths at vertices [m]. Zero for junctions and vertices that are held.
///
/// Away from borders (paper, Sec. 3.3.1, after DistMesh: Persson & Strang, SIAM Rev. 46, 2004): edges push
/// their ends apart where they are shorter than ℓ₀ = 1.2 s q, by 0.2 (ℓ₀ − ℓ); s is the mean target of the
/// ends and q = (Σℓ²/Σs²)^{1/2} over the edges of the vertex, so that what counts is how edges compare with
/// each other.
///
/// A film vertex beside a border or junction: such springs would push it into the border, where nothing
/// pushes back. It goes 0.7 of the way to the mean of its triangles' centroids, weighted by area over s³,
/// which grades spacings as s varies.
///
/// A border vertex slides along its border only: half of the way to where its two edges are as long as their
/// targets say, pulled as well as pushed, so that spacings become even.
Vec3 wanted_displacement(const StarMesh& star_mesh, std::span<const double> target, int v);

}  // namespace spume::meshing
