#include "spume/simulation/film_update.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <set>
#include <utility>

#include "spume/mesh/measure.hpp"

namespace spume::simulation {

namespace {

using PhasePairs = std::set<std::pair<mesh::Phase, mesh::Phase>>;

/// Pairs of phases that share a film; those of phases that were born or died in the reconstruction say
/// nothing of T1s.
PhasePairs phase_pairs(const mesh::Topology& topology, const interface::ReconstructReport& report) {
  PhasePairs pairs;
  for (const auto& lamella : topology.lamella) pairs.insert({lamella.phase_a, lamella.phase_b});
  using Kind = interface::ReconstructReport::PhaseChange::Kind;
  std::erase_if(pairs, [&](const auto& pair) {
    return std::any_of(report.changes.begin(), report.changes.end(), [&](const auto& change) {
      const mesh::Phase other = change.kind == Kind::Absorbed ? change.phase : change.other;
      const auto has = [&](mesh::Phase p) { return p > 0 && (pair.first == p || pair.second == p); };
      return change.kind != Kind::Absorbed && (has(change.phase) || has(other));
    });
  });
  return pairs;
}

std::string list(const PhasePairs& all, const PhasePairs& without) {
  std::string text;
  for (const auto& [a, b] : all)
    if (!without.contains({a, b})) text += fmt::format("{}{}|{}", text.empty() ? "" : " ", a, b);
  return text.empty() ? "none" : text;
}

state::Event describe(double time, const interface::ReconstructReport::PhaseChange& change) {
  using Kind = interface::ReconstructReport::PhaseChange::Kind;
  switch (change.kind) {
    case Kind::Split:
      return {time, "bubble split",
              fmt::format("a piece of bubble {} is bubble {} now; volume {:.4g} m3", change.phase,
                          change.other, change.volume)};
    case Kind::Pocket:
      return {time, "pocket",
              fmt::format("an enclosed piece of the outside is bubble {} now; volume {:.4g} m3", change.other,
                          change.volume)};
    case Kind::Absorbed:
      return {time, "piece absorbed",
              fmt::format("a piece of phase {} too small to keep went to its neighbours; volume {:.4g} m3",
                          change.phase, change.volume)};
    case Kind::Lost:
      return {time, "bubble lost",
              fmt::format("bubble {} is too small for the grid; its gas of {:.4g} m3 went to phase {}",
                          change.phase, change.volume, change.other)};
  }
  return {time, "phase change", ""};
}

}  // namespace

FilmUpdate reconstruct_films(const grid::Grid& grid, const Case& run_case, const mesh::Topology& topology,
                             state::Foam& foam) {
  return take_over(grid.communicator(), run_case, grid.h(),
                   interface::reconstruct(grid, foam.films, topology, foam.phases, run_case.reconstruct),
                   topology, foam);
}

FilmUpdate take_over(const parallel::Communicator& ranks, const Case& run_case, double h,
                     interface::Reconstruction reconstruction, const mesh::Topology& topology_before,
                     state::Foam& foam) {
  const double old_area = mesh::film_area(foam.films);
  FilmUpdate update;
  update.reconstruction = std::move(reconstruction.report);
  update.potentials = std::move(reconstruction.potentials);
  update.topology = std::move(reconstruction.topology);
  replace_films(ranks, run_case, h, std::move(reconstruction.films), update.topology, topology_before, foam,
                update.transfer);
  update.energy_correction =
      2 * run_case.materials.film.surface_tension * (mesh::film_area(foam.films) - old_area);

  const auto& report = update.reconstruction;
  for (const auto& change : report.changes) update.events.push_back(describe(foam.time, change));
  const PhasePairs before = phase_pairs(topology_before, report),
                   after = phase_pairs(update.topology, report);
  if (before != after)
    update.events.push_back(
        {foam.time, "T1",
         fmt::format("films gone: {}; films new: {}", list(before, after), list(after, before))});
  if (report.n_nonconforming_edges > 0 || report.n_refused_projections > 0)
    update.events.push_back(
        {foam.time, "poor reconstruction",
         fmt::format("{} edges belong to no film or border; {} vertices were not put onto their films",
                     report.n_nonconforming_edges, report.n_refused_projections)});
  return update;
}

void replace_films(const parallel::Communicator& ranks, const Case& run_case, double h, mesh::FilmMesh films,
                   const mesh::Topology& topology, const mesh::Topology& topology_before, state::Foam& foam,
                   transport::TransferReport& report) {
  foam.liquid = transport::transfer(ranks, foam.films, topology_before, foam.liquid, films, topology, h,
                                    run_case.transport, report);
  foam.films = std::move(films);
}

}  // namespace spume::simulation
