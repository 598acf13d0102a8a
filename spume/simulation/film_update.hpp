#pragma once

#include <memory>
#include <vector>

#include "spume/interface/reconstruct.hpp"
#include "spume/mesh/topology.hpp"
#include "spume/simulation/case.hpp"
#include "spume/state/events.hpp"
#include "spume/state/foam.hpp"

namespace spume::simulation {

/// What came of a new film mesh.
struct FilmUpdate {
  mesh::Topology topology;
  std::shared_ptr<const interface::PhasePotentials> potentials;
  interface::ReconstructReport reconstruction;
  transport::TransferReport transfer;
  double energy_correction = 0;  ///< change of 2σA by the reconstruction [J]
  /// T1, bubble split, pocket, piece absorbed, bubble lost, poor reconstruction.
  std::vector<state::Event> events;
};

/// Reconstructs the films of a foam and carries the liquid over. A change of the set of phase pairs that
/// share films is reported as a T1. `topology` is that of foam.films. Collective.
FilmUpdate reconstruct_films(const grid::Grid& grid, const Case& run_case, const mesh::Topology& topology,
                             state::Foam& foam);

/// Makes reconstructed films those of a foam, with its liquid, and tells what changed. foam.phases are those
/// after the reconstruction already, foam.films those before, with their topology. Collective.
FilmUpdate take_over(const parallel::Communicator& ranks, const Case& run_case, double h,
                     interface::Reconstruction reconstruction, const mesh::Topology& topology_before,
                     state::Foam& foam);

/// Gives a foam, whose films have `topology_before`, another mesh of the same films, with its liquid.
/// Collective.
void replace_films(const parallel::Communicator& ranks, const Case& run_case, double h, mesh::FilmMesh films,
                   const mesh::Topology& topology, const mesh::Topology& topology_before, state::Foam& foam,
                   transport::TransferReport& report);

}  // namespace spume::simulation
