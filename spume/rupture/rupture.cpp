#include "spume/rupture/rupture.hpp"

#include <algorithm>
#include <span>
#include <utility>
#include <vector>

#include "spume/base/contract.hpp"
#include "spume/mesh/measure.hpp"
#include "spume/rupture/inject.hpp"
#include "spume/rupture/merge_phases.hpp"
#include "spume/rupture/redistribute.hpp"

namespace spume::rupture {

namespace {

void expect_sizes(const mesh::Topology& topology, const state::FilmLiquid& liquid) {
  expects(liquid.lamella_volume.size() == topology.film_dof.size(), "one liquid volume per film dof");
  expects(liquid.border_volume.size() == topology.border_dof.size(), "one liquid volume per border dof");
  expects(liquid.lamella_is_young.size() == topology.lamella.size(), "one young flag per lamella");
  expects(liquid.lamella_area_at_transfer.size() == topology.lamella.size(), "one area per lamella");
}

std::vector<char> torn_lamellae(const mesh::Topology& topology, mesh::Phase kept, mesh::Phase gone) {
  std::vector<char> is_torn;
  for (const auto& lamella : topology.lamella)
    is_torn.push_back(lamella.phase_a == std::min(kept, gone) && lamella.phase_b == std::max(kept, gone));
  return is_torn;
}

/// The pair that is left of three phases around a border when `gone` becomes `kept`.
mesh::Lamella film_of_ridge(const mesh::PlateauBorder& border, mesh::Phase kept, mesh::Phase gone) {
  for (mesh::Phase p : border.phases)
    if (p != kept && p != gone) return {std::min(kept, p), std::max(kept, p)};
  return {kept, kept};
}

/// Each edge of a border that is gone, with what the edge received and its part of what the border's dofs
/// held.
std::vector<LiquidBall> balls_of_ridges(const mesh::FilmMesh& films, const mesh::Topology& topology,
                                        const MergedMesh& merged, const TornLiquid& torn,
                                        std::span<const double> border_volume, mesh::Phase kept,
                                        mesh::Phase gone) {
  const std::vector<double> length = border_edge_lengths(films, topology);
  std::vector<double> length_at_dof(topology.border_dof.size(), 0);
  std::vector<int> edges_at_dof(topology.border_dof.size(), 0);
  for (std::size_t e = 0; e < length.size(); ++e)
    for (int d : topology.border_edge[e].border_dof) {
      length_at_dof[d] += length[e];
      ++edges_at_dof[d];
    }
  std::vector<LiquidBall> balls;
  for (std::size_t e = 0; e < length.size(); ++e) {
    const auto& edge = topology.border_edge[e];
    double volume = torn.on_edge[e];
    for (int d : edge.border_dof) {
      if (merged.border_dof[d] >= 0) continue;
      volume +=
          border_volume[d] * (length_at_dof[d] > 0 ? length[e] / length_at_dof[d] : 1.0 / edges_at_dof[d]);
    }
    if (!(volume > 0)) continue;
    balls.push_back({films.position[edge.vertex[0]] + 0.5 * films.edge(edge.vertex[0], edge.vertex[1]),
                     volume, film_of_ridge(topology.border[edge.border], kept, gone)});
  }
  return balls;
}

/// Liquid, flags and areas on the merged mesh; dofs and lamellae that became one add up.
state::FilmLiquid follow(const MergedMesh& merged, const state::FilmLiquid& old) {
  state::FilmLiquid liquid;
  liquid.sprayed = old.sprayed;
  liquid.lamella_volume.assign(merged.topology.film_dof.size(), 0);
  liquid.border_volume.assign(merged.topology.border_dof.size(), 0);
  for (std::size_t d = 0; d < old.lamella_volume.size(); ++d)
    if (merged.film_dof[d] >= 0) liquid.lamella_volume[merged.film_dof[d]] += old.lamella_volume[d];
  for (std::size_t d = 0; d < old.border_volume.size(); ++d)
    if (merged.border_dof[d] >= 0) liquid.border_volume[merged.border_dof[d]] += old.border_volume[d];

  // A merged lamella is as young as the largest of those it is made of.
  liquid.lamella_is_young.assign(merged.topology.lamella.size(), 0);
  liquid.lamella_area_at_transfer.assign(merged.topology.lamella.size(), 0);
  std::vector<double> largest(merged.topology.lamella.size(), -1);
  for (std::size_t l = 0; l < merged.lamella.size(); ++l) {
    const int lamella = merged.lamella[l];
    if (lamella < 0) continue;
    const double area = old.lamella_area_at_transfer[l];
    liquid.lamella_area_at_transfer[lamella] += area;
    if (area <= largest[lamella]) continue;
    largest[lamella] = area;
    liquid.lamella_is_young[lamella] = old.lamella_is_young[l];
  }
  return liquid;
}

void merge_targets(state::Phases& phases, mesh::Phase kept, mesh::Phase gone) {
  expects(gone < phases.count(), "both phases are known");
  if (kept != 0) phases.target_volume[kept] += phases.target_volume[gone];
  phases.target_volume[gone] = 0;
  if (gone == phases.above_membrane) phases.above_membrane = 0;
}

/// What opens to a part of the outside becomes that part; of two bubbles the lower number stays.
std::pair<mesh::Phase, mesh::Phase> kept_and_gone(mesh::Phase a, mesh::Phase b, const state::Phases& phases) {
  const auto [low, high] = std::minmax(a, b);
  if (low != 0 && high == phases.above_membrane) return {high, low};
  return {low, high};
}

}  // namespace

RuptureReport rupture(mesh::Phase a, mesh::Phase b, mesh::FilmMesh& films, state::FilmLiquid& liquid,
                      state::Phases& phases, Fate fate, double injection_radius) {
  expects(a != b && a >= 0 && b >= 0 && injection_radius > 0, "a film between two phases ruptures");
  const auto [kept, gone] = kept_and_gone(a, b, phases);
  const mesh::Topology topology = mesh::build_topology(films);
  expect_sizes(topology, liquid);
  const std::vector<char> is_torn = torn_lamellae(topology, kept, gone);
  RuptureReport report{kept, gone, 0, 0, 0, 0, 0, 0};
  const std::vector<double> areas = mesh::lamella_areas(films, topology);
  for (std::size_t l = 0; l < is_torn.size(); ++l) {
    if (!is_torn[l]) continue;
    ++report.n_lamellae;
    report.area += areas[l];
  }
  expects(report.n_lamellae > 0, "there is a film between the phases");
  for (std::size_t d = 0; d < liquid.lamella_volume.size(); ++d)
    if (is_torn[topology.film_dof[d].lamella]) report.liquid += liquid.lamella_volume[d];

  TornLiquid torn = redistribute(films, topology, is_torn, liquid.lamella_volume);
  if (fate == Fate::Spray) {
    torn.on_edge.assign(torn.on_edge.size(), 0);
    torn.without_border.clear();
    report.sprayed = report.liquid;
  } else {
    report.to_borders = torn.to_borders;
  }

  MergedMesh merged = merge_phases(films, topology, kept, gone);
  std::vector<LiquidBall> balls =
      balls_of_ridges(films, topology, merged, torn, liquid.border_volume, kept, gone);
  const bool nothing_left = merged.films.triangle.empty();
  for (int d : torn.without_border) {
    const double volume = liquid.lamella_volume[d];
    if (nothing_left)
      report.sprayed += volume;  // the last bubble: no film is left to hold liquid
    else
      balls.push_back({films.position[topology.film_dof[d].vertex], volume, std::nullopt});
  }

  state::FilmLiquid merged_liquid = follow(merged, liquid);
  merged_liquid.sprayed += report.sprayed;
  report.to_films =
      inject(balls, merged.films, merged.topology, injection_radius, merged_liquid.lamella_volume);
  merge_targets(phases, kept, gone);
  films = std::move(merged.films);
  liquid = std::move(merged_liquid);
  return report;
}

}  // namespace spume::rupture
