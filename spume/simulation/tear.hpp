#pragma once

#include "spume/rupture/rupture.hpp"
#include "spume/simulation/film_update.hpp"

namespace spume::simulation {

/// Part D of the paper: removes all films between two phases, gives their liquid to the neighbours, merges
/// the phases and reconstructs the films. Events tell what happened, the change of film energy included.
/// Collective.
FilmUpdate tear(const grid::Grid& grid, const Case& run_case, mesh::Phase a, mesh::Phase b,
                state::Foam& foam);

}  // namespace spume::simulation
