#include "spume/interface/find_films.hpp"

#include <algorithm>
#include <utility>
#include <vector>

#include "spume/base/random.hpp"
#include "spume/interface/contour.hpp"
#include "spume/interface/project_junction.hpp"

namespace spume::interface {

namespace {

/// Makes phases single pieces; `winners` follow.
void separate(const parallel::Communicator& ranks, PhasePotentials& potentials,
              std::vector<mesh::Phase>& winners, state::Phases& phases, double smallest_volume,
              std::vector<PhaseChange>& changes) {
  constexpr int max_rounds = 4;
  for (int n = 0; n < max_rounds && separate_pieces(potentials, winners, phases, smallest_volume, changes);
       ++n)
    winners = find_winners(potentials, ranks);
}

/// Adds noise of the given amplitude [m] to all potentials where the two largest are within four cells.
void perturb_ties(PhasePotentials& potentials, double amplitude, std::uint64_t seed) {
  Random random(seed);
  const double near = 4 * potentials.h();
  const std::vector<double> lead = leads_of_winners(potentials);
  std::vector<mesh::Phase> phases;
  for (const auto& field : potentials.fields()) phases.push_back(field.phase);
  for (mesh::Phase p : phases) {
    PhaseField& field = *potentials.find(p);
    for_each_cell_of_grid(field.cells, potentials.lattice(), [&](std::size_t n, std::size_t cell) {
      if (lead[cell] < near) field.value[n] += amplitude * random.uniform(-0.5, 0.5);
    });
  }
}

}  // namespace

FoundFilms find_films(const parallel::Communicator& ranks, PhasePotentials& potentials,
                      std::vector<mesh::Phase> winners, state::Phases& phases, double smallest_volume,
                      std::vector<PhaseChange>& changes) {
  constexpr int max_retries = 3;
  const std::size_t first_change = changes.size();
  double amplitude = 1e-9 * potentials.h();
  FoundFilms found;
  for (int retry = 0;; ++retry) {
    separate(ranks, potentials, winners, phases, smallest_volume, changes);
    found.films = contour(ranks, potentials, winners);
    found.topology = mesh::build_topology(found.films);
    if (retry == max_retries) break;
    const std::vector<ClosedSurface> surfaces = closed_surfaces(found.films, found.topology);
    const int n_specks = suppress_specks(potentials, winners, surfaces, smallest_volume);
    const TornBubbles torn = torn_bubbles(potentials.h(), surfaces, smallest_volume);
    const bool separated =
        !torn.phase.empty() && separate_pieces(potentials, winners, phases, smallest_volume, changes, torn);
    if (n_specks == 0 && !separated && found.topology.n_nonconforming_edges == 0) break;
    if (found.topology.n_nonconforming_edges > 0) {
      perturb_ties(potentials, amplitude, retry);
      amplitude *= 10;
    }
    winners = find_winners(potentials, ranks);
  }
  settle_new_phases(found.films, found.topology, phases, changes, first_change);
  return found;
}

int project_vertices(const parallel::Communicator& ranks, const PhasePotentials& potentials,
                     const mesh::Topology& topology, mesh::FilmMesh& films) {
  const std::vector<int> share = ranks.shares(films.n_vertices());
  const int first = share[ranks.rank()], end = share[ranks.rank() + 1];
  // Junctions look at vertices around them, which must still be where they were on every rank.
  std::vector<Vec3> point(films.position.begin() + first, films.position.begin() + end);
  int n_refused = 0;
  for (int v = first; v < end; ++v) {
    const bool is_junction = topology.vertex_kind[v] == mesh::VertexKind::Junction;
    const auto projected = is_junction ? project_junction(potentials, films, topology, v)
                                       : potentials.project(films.position[v], topology.vertex_phases[v]);
    if (projected)
      point[v - first] = *projected;
    else if (!is_junction)
      ++n_refused;
  }
  std::copy(point.begin(), point.end(), films.position.begin() + first);
  ranks.all_gather(std::span(films.position), share);
  return static_cast<int>(ranks.sum(n_refused));
}

void project_junctions(const PhasePotentials& potentials, const mesh::Topology& topology,
                       mesh::FilmMesh& films) {
  std::vector<Vec3> point;
  point.reserve(topology.junction.size());
  for (int v : topology.junction)
    point.push_back(project_junction(potentials, films, topology, v).value_or(films.position[v]));
  for (std::size_t n = 0; n < point.size(); ++n) films.position[topology.junction[n]] = point[n];
}

}  // namespace spume::interface
