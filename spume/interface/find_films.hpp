#pragma once

#include <vector>

#include "spume/interface/phase_pieces.hpp"
#include "spume/interface/potentials.hpp"
#include "spume/interface/reconstruct.hpp"
#include "spume/mesh/film_mesh.hpp"
#include "spume/mesh/topology.hpp"
#include "spume/parallel/communicator.hpp"

namespace spume::interface {

/// A contour whose phases are single pieces and whose edges conform, before projection.
struct FoundFilms {
  mesh::FilmMesh films;
  mesh::Topology topology;
};

/// From potentials and their winners: separates pieces, contours, suppresses specks, and gives new phases
/// their target volumes. Where edges do not conform (exact ties), the potentials near ties are perturbed by
/// 1e-9 h, then 1e-8 h, then 1e-7 h. Collective.
FoundFilms find_films(const parallel::Communicator& ranks, PhasePotentials& potentials,
                      std::vector<mesh::Phase> winners, state::Phases& phases, double smallest_volume,
                      std::vector<PhaseChange>& changes);

/// Puts the vertices onto the tie of their phases by Newton's method, junctions by project_junction(); gives
/// the number of those on films and borders that stayed where they were: that junctions do is part of a T1.
/// Each rank does its share of them. Collective.
int project_vertices(const parallel::Communicator& ranks, const PhasePotentials& potentials,
                     const mesh::Topology& topology, mesh::FilmMesh& films);

/// The same for junctions alone, on every rank.
void project_junctions(const PhasePotentials& potentials, const mesh::Topology& topology,
                       mesh::FilmMesh& films);

}  // namespace spume::interface
