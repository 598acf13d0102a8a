#include "spume/simulation/drain_films.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <numeric>

#include "spume/base/error.hpp"
#include "spume/interface/reconstruct.hpp"
#include "spume/mesh/measure.hpp"
#include "spume/mesh/volume_constraint.hpp"
#include "spume/meshing/mesh_films.hpp"
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

/// Width of the boundary layers at the films' rims [m], from the mean η and λ; 0 where there are no borders.
double layer_width(const state::Foam& foam, const mesh::Topology& topology) {
  const auto lengths = mesh::border_dof_lengths(foam.films, topology);
  const double area = mesh::film_area(foam.films),
               length = std::accumulate(lengths.begin(), lengths.end(), 0.0);
  const auto sum = [](const std::vector<double>& volume) {
    return std::accumulate(volume.begin(), volume.end(), 0.0);
  };
  if (!(area > 0 && length > 0)) return 0;
  return meshing::drainage_layer_width(sum(foam.liquid.lamella_volume) / (2 * area),
                                       sum(foam.liquid.border_volume) / length);
}

/// Reconstructs the films once more, for a projection onto them, and gives them the mesh for drainage.
void mesh_films(const grid::Grid& grid, const Case& run_case, RunState& run, Witness& witness) {
  const double old_area = mesh::film_area(run.foam.films);
  FilmUpdate update = reconstruct_films(grid, run_case, mesh::build_topology(run.foam.films), run.foam);
  witness.events(update.events);
  mesh::FilmMesh films = run.foam.films;
  meshing::MeshingParameters parameters = run_case.meshing;
  parameters.layer_width = layer_width(run.foam, update.topology);
  const auto report =
      meshing::improve(films, interface::projection_onto(update.potentials), grid.h(), parameters);
  if (run_case.rearrangement.conserve_volumes)
    mesh::restore_volumes(films, run.foam.phases.target_volume, 3, 0.1 * grid.h());
  const mesh::Topology topology = mesh::build_topology(films);
  replace_films(grid.communicator(), run_case, grid.h(), std::move(films), topology, update.topology,
                run.foam, update.transfer);
  const double correction =
      2 * run_case.materials.film.surface_tension * (mesh::film_area(run.foam.films) - old_area);
  witness.step(run, topology, {.correction = correction}, "meshing");
  if (report.after.smallest_angle_degrees < run_case.meshing.smallest_angle_degrees ||
      report.after.n_inverted > 0)
    witness.event(run, "poor mesh",
                  fmt::format("smallest angle {:.3g} degrees; {} inverted triangles",
                              report.after.smallest_angle_degrees, report.after.n_inverted));
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
