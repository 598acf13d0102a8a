#include "spume/simulation/drain_films.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "spume/base/error.hpp"
#include "spume/mesh/measure.hpp"
#include "spume/simulation/drainage_mesh.hpp"
#include "spume/simulation/film_source.hpp"
#include "spume/simulation/film_update.hpp"

namespace spume::simulation {

namespace {

/// Lamellae smaller than a few cells are left-overs of T1s; what is thinnest there says nothing. Films from a
/// file know no cells, and all count.
double smallest_area(const grid::Grid& grid, const Case& run_case) {
  constexpr double cells = 4;
  return run_case.foam.films ? 0 : cells * grid.h() * grid.h();
}

const char* name(mesh::VertexKind kind) {
  switch (kind) {
    case mesh::VertexKind::Film:
      return "inside the film";
    case mesh::VertexKind::Border:
      return "at a Plateau border";
    case mesh::VertexKind::Junction:
      return "at a junction";
  }
  return "";
}

/// Gives the foam the mesh for drainage.
void mesh_films(const grid::Grid& grid, const Case& run_case, RunState& run, Witness& witness) {
  const double old_area = mesh::film_area(run.foam.films);
  std::vector<state::Event> events;
  DrainageMesh mesh = mesh_for_drainage(grid, run_case, run.foam, events);
  witness.events(events);
  replace_films(grid.communicator(), run_case, grid.h(), std::move(mesh.films), mesh.topology,
                mesh.update.topology, run.foam, mesh.update.transfer);
  const double correction =
      2 * run_case.materials.film.surface_tension * (mesh::film_area(run.foam.films) - old_area);
  witness.step(run, mesh.topology, {.correction = correction}, "meshing");
  const auto& quality = mesh.report.after;
  if (mesh.n_relaxation_steps > 0)
    witness.event(
        run, "relaxed",
        fmt::format("{} steps without gas before drainage: smallest angle of its mesh {:.3g} degrees, "
                    "before {:.3g}",
                    mesh.n_relaxation_steps, quality.smallest_angle_degrees, mesh.first_smallest_angle));
  if (quality.smallest_angle_degrees < run_case.meshing.smallest_angle_degrees || mesh.n_turned > 0)
    witness.event(run, "poor mesh",
                  fmt::format("smallest angle {:.3g} degrees; {} turned triangles",
                              quality.smallest_angle_degrees, mesh.n_turned));
}

std::optional<Weakest> weakest_of(const mesh::Topology& topology, const state::ThinPoint& point) {
  if (point.lamella < 0) return std::nullopt;
  const auto& lamella = topology.lamella[point.lamella];
  return Weakest{lamella.phase_a, lamella.phase_b, point};
}

std::string describe(const drainage::DrainageOutcome& outcome, const Weakest& weakest) {
  return fmt::format(
      "after {:.6g} s in {} steps ({} rejected); thinnest {:.4g} m {} of film {}|{}; ledger off by {:.2g}",
      outcome.elapsed, outcome.n_steps, outcome.n_rejected, weakest.point.half_thickness,
      name(weakest.point.kind), weakest.phase_a, weakest.phase_b, outcome.ledger_error);
}

}  // namespace

state::FilmNetwork network_of(const state::Foam& foam) {
  return network_of(foam.films, foam.liquid);
}

void store(const state::FilmNetwork& network, state::FilmLiquid& liquid) {
  const auto& topology = network.topology;
  const auto area = mesh::film_dof_areas(network.mesh, topology);
  for (std::size_t d = 0; d < area.size(); ++d)
    liquid.lamella_volume[d] = 2 * network.half_thickness[d] * area[d];
  const auto length = mesh::border_dof_lengths(network.mesh, topology);
  for (std::size_t d = 0; d < length.size(); ++d)
    liquid.border_volume[d] = network.border_area[topology.border_dof[d].vertex] * length[d];
}

std::optional<Weakest> drain_films(const grid::Grid& grid, const Case& run_case, RunState& run,
                                   Witness& witness) {
  if (!run_case.foam.films) mesh_films(grid, run_case, run, witness);
  for (auto& component : run.foam.gas.velocity.components) component.fill(0);
  run.foam.gas.pressure.fill(0);

  state::FilmNetwork network = network_of(run.foam);
  const double start = run.foam.time;
  drainage::DrainageParameters parameters = run_case.drainage;
  parameters.max_time = std::min(parameters.max_time, run_case.cycle.end_time - start);
  const auto criterion = [&](const state::FilmNetwork& n) {
    return rupture::thinnest_point(n, run_case.rupture, smallest_area(grid, run_case));
  };
  run.next_frame = start;
  const auto on_step = [&](const drainage::DrainageProgress& progress, const state::FilmNetwork& now) {
    run.foam.time = start + progress.elapsed;
    store(now, run.foam.liquid);
    witness.step(run, now.topology,
                 {.dt = progress.step, .min_half_thickness = progress.thinnest.half_thickness},
                 progress.limited_by);
    witness.frame_if_due(run, now.topology, run_case.output.drainage_interval);
    return !witness.stop_wanted();
  };
  const auto outcome = drainage::drain(network, run_case.materials, parameters, run_case.rupture.threshold,
                                       criterion, on_step, grid.communicator());
  if (outcome.ending == drainage::Ending::Stopped)
    throw Interrupted("stopped while the films drained; the run resumes from the start of this drainage");

  run.foam.time = start + outcome.elapsed;
  store(network, run.foam.liquid);
  witness.frame(run, network.topology, run_case.output.drainage_interval);
  const auto weakest = weakest_of(network.topology, outcome.thinnest);
  if (outcome.ending == drainage::Ending::Ruptured && weakest) {
    witness.event(run, "film too thin", describe(outcome, *weakest));
    return weakest;
  }
  witness.event(run, "drained",
                weakest ? describe(outcome, *weakest)
                        : fmt::format("after {:.6g} s; no film may rupture", outcome.elapsed));
  return std::nullopt;
}

std::optional<Weakest> weakest_lamella(const grid::Grid& grid, const Case& run_case,
                                       const state::Foam& foam) {
  const state::FilmNetwork network = network_of(foam);
  return weakest_of(network.topology,
                    rupture::thinnest_point(network, run_case.rupture, smallest_area(grid, run_case)));
}

}  // namespace spume::simulation
