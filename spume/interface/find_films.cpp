#include "spume/interface/find_films.hpp"

#include <utility>
#include <vector>

#include "spume/base/random.hpp"
#include "spume/interface/contour.hpp"

namespace spume::interface {

namespace {

/// Winners of potentials whose phases are single pieces.
Winners separated(PhasePotentials& potentials, state::Phases& phases, double smallest_volume,
                  std::vector<PhaseChange>& changes) {
  constexpr int max_rounds = 4;
  Winners winners = find_winners(potentials);
  for (int n = 0; n < max_rounds && separate_pieces(potentials, winners, phases, smallest_volume, changes);
       ++n)
    winners = find_winners(potentials);
  return winners;
}

/// Adds noise of the given amplitude [m] to all potentials where the two largest are within four cells.
void perturb_ties(PhasePotentials& potentials, const Winners& winners, double amplitude, std::uint64_t seed) {
  Random random(seed);
  const double near = 4 * potentials.h();
  std::vector<mesh::Phase> phases;
  for (const auto& field : potentials.fields()) phases.push_back(field.phase);
  for (mesh::Phase p : phases) {
    PhaseField& field = *potentials.find(p);
    for_each_cell_of_grid(field.cells, potentials.lattice(), [&](std::size_t n, std::size_t cell) {
      if (winners.first[cell] - winners.second[cell] < near)
        field.value[n] += amplitude * random.uniform(-0.5, 0.5);
    });
  }
}

}  // namespace

FoundFilms find_films(PhasePotentials& potentials, state::Phases& phases, double smallest_volume,
                      std::vector<PhaseChange>& changes) {
  constexpr int max_retries = 3;
  const std::size_t first_change = changes.size();
  double amplitude = 1e-9 * potentials.h();
  FoundFilms found;
  for (int retry = 0;; ++retry) {
    const Winners winners = separated(potentials, phases, smallest_volume, changes);
    found.films = contour(potentials, winners.phase);
    found.topology = mesh::build_topology(found.films);
    if (retry == max_retries) break;
    const int n_specks = suppress_specks(potentials, winners, found.films, found.topology, smallest_volume);
    if (n_specks == 0 && found.topology.n_nonconforming_edges == 0) break;
    if (found.topology.n_nonconforming_edges > 0) {
      perturb_ties(potentials, winners, amplitude, retry);
      amplitude *= 10;
    }
  }
  settle_new_phases(found.films, found.topology, phases, changes, first_change);
  return found;
}

int project_vertices(const parallel::Communicator& ranks, const PhasePotentials& potentials,
                     const mesh::Topology& topology, mesh::FilmMesh& films) {
  const auto begin_of = [&](int rank) {
    return static_cast<int>(static_cast<long>(films.n_vertices()) * rank / ranks.size());
  };
  int n_refused = 0;
  for (int v = begin_of(ranks.rank()); v < begin_of(ranks.rank() + 1); ++v) {
    const auto projected = potentials.project(films.position[v], topology.vertex_phases[v]);
    if (projected)
      films.position[v] = *projected;
    else
      ++n_refused;
  }
  if (ranks.size() == 1) return n_refused;
  std::vector<double> share;
  for (int rank = 0; rank < ranks.size(); ++rank) {
    const int begin = begin_of(rank), end = begin_of(rank + 1);
    share.resize(3 * static_cast<std::size_t>(end - begin));
    for (int v = begin; v < end; ++v)
      for (int d = 0; d < 3; ++d) share[3 * (v - begin) + d] = films.position[v][d];
    ranks.broadcast(share, rank);
    for (int v = begin; v < end; ++v)
      for (int d = 0; d < 3; ++d) films.position[v][d] = share[3 * (v - begin) + d];
  }
  return static_cast<int>(ranks.sum(n_refused));
}

void project_junctions(const PhasePotentials& potentials, const mesh::Topology& topology,
                       mesh::FilmMesh& films) {
  for (int v : topology.junction)
    films.position[v] =
        potentials.project(films.position[v], topology.vertex_phases[v]).value_or(films.position[v]);
}

}  // namespace spume::interface
