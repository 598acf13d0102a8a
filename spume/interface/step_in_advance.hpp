#pragma once

#include "spume/mesh/film_mesh.hpp"
#include "spume/mesh/topology.hpp"

namespace spume::interface {

/// Moves every vertex by −t F'_v/A_v, which undoes in advance the curvature flow over the "time" t [m²] that
/// smoothing brings. F' = −∂A/∂x_v less its pure-pressure part [m] (so that equilibria stay, and volumes to
/// first order), A_v the lumped area. Film vertices move along their normal and by the mean over their star,
/// which keeps the step from roughening the film. No move is longer than 0.1 × `spacing` [m].
void step_in_advance(mesh::FilmMesh& films, const mesh::Topology& topology, double t, double spacing,
                     int n_phases);

}  // namespace spume::interface
