#pragma once

#include "spume/mesh/film_mesh.hpp"
#include "spume/mesh/topology.hpp"
#include "spume/state/film_frame.hpp"
#include "spume/state/film_liquid.hpp"

namespace spume::io {

/// Half-thickness of every film dof, η = volume/(2 lumped area) [m].
std::vector<double> half_thickness(const mesh::FilmMesh& films, const mesh::Topology& topology,
                                   const state::FilmLiquid& liquid);
/// Cross-section of every border dof, λ = volume/lumped length [m²].
std::vector<double> border_area(const mesh::FilmMesh& films, const mesh::Topology& topology,
                                const state::FilmLiquid& liquid);

/// The films as a frame: film point d is film dof d, border point d is border dof d. `time` [s].
state::FilmFrame film_frame(const mesh::FilmMesh& films, const mesh::Topology& topology,
                            const state::FilmLiquid& liquid, double time);

}  // namespace spume::io
