#pragma once

#include <optional>

#include "spume/simulation/run_state.hpp"
#include "spume/simulation/witness.hpp"
#include "spume/state/film_network.hpp"

namespace spume::simulation {

/// network_of() of film_source.hpp for a foam.
state::FilmNetwork network_of(const state::Foam& foam);
/// The liquid of a drained network back as volumes on the same mesh.
void store(const state::FilmNetwork& network, state::FilmLiquid& liquid);

/// The lamella that goes next and its phases.
struct Weakest {
  mesh::Phase phase_a, phase_b;
  state::ThinPoint point;
};

/// Part C of the paper: meshes the films at rest (films from a file stay as they are), drains them, and says
/// which lamella ruptures; none when the stage's or the run's time is up first. The gas is at rest
/// afterwards: seconds of drainage outlast its motion. Collective. Throws Interrupted when the user wants to
/// stop: the checkpoint of the stage's start stands.
std::optional<Weakest> drain_films(const grid::Grid& grid, const Case& run_case, RunState& run,
                                   Witness& witness);

/// The lamella that is thinnest now, for runs without drainage.
std::optional<Weakest> weakest_lamella(const grid::Grid& grid, const Case& run_case, const state::Foam& foam);

}  // namespace spume::simulation
