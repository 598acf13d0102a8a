#include "spume/simulation/drainage_mesh.hpp"

#include <algorithm>
#include <cmath>
#include <memory>
#include <numeric>
#include <utility>

#include "spume/base/stage_times.hpp"
#include "spume/interface/find_films.hpp"
#include "spume/interface/potentials.hpp"
#include "spume/interface/volume_constants.hpp"
#include "spume/mesh/measure.hpp"
#include "spume/mesh/volume_constraint.hpp"
#include "spume/meshing/figures.hpp"
#include "spume/simulation/equilibrate.hpp"

namespace spume::simulation {

namespace {

constexpr int volume_rounds = 2;                  // each leaves about a sixth of the error
constexpr double largest_shift_cells = 0.2;       // of a potential, in a round
constexpr double largest_last_step = 0.1;         // of a vertex, for the rest [h]
constexpr int steps_at_once = 5, most_times = 6;  // of relaxation, where a T1 goes on

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

/// Raises the potentials so that the films enclose the volumes of the bubbles, by how much their vertices,
/// projected, do not.
void fit_potentials(const grid::Grid& grid, interface::PhasePotentials& potentials, mesh::FilmMesh films,
                    const mesh::Topology& topology, const state::Phases& phases) {
  for (int round = 0; round < volume_rounds; ++round) {
    interface::project_vertices(grid.communicator(), potentials, topology, films);
    interface::raise_to_volumes(potentials, films, phases, largest_shift_cells * grid.h());
  }
}

/// The same for a finished mesh, which follows.
void fit_mesh(double h, interface::PhasePotentials& potentials, const mesh::Projection& project,
              const state::Phases& phases, mesh::FilmMesh& films, int& n_off) {
  for (int round = 0; round < volume_rounds; ++round) {
    interface::raise_to_volumes(potentials, films, phases, largest_shift_cells * h);
    n_off = meshing::follow_films(films, project);
  }
  mesh::restore_volumes(films, phases.target_volume, 3, largest_last_step * h);
}

/// Half of the largest change of a difference between the constants of two phases that share a film [m].
double largest_shift(const interface::PhasePotentials& before, const interface::PhasePotentials& after,
                     const mesh::Topology& topology) {
  const auto raised = [&](mesh::Phase p) {
    return after.find(p) ? after.find(p)->beyond - before.find(p)->beyond : 0.0;
  };
  double largest = 0;
  for (const auto& lamella : topology.lamella)
    largest = std::max(largest, 0.5 * std::abs(raised(lamella.phase_a) - raised(lamella.phase_b)));
  return largest;
}

void mesh_once(const grid::Grid& grid, const Case& run_case, state::Foam& foam,
               std::vector<state::Event>& events, DrainageMesh& result) {
  result.update = reconstruct_films(grid, run_case, mesh::build_topology(foam.films), foam);
  const FilmUpdate& update = result.update;
  events.insert(events.end(), update.events.begin(), update.events.end());
  const double start = processor_time();
  const bool fits = run_case.rearrangement.conserve_volumes;
  const auto potentials = std::make_shared<interface::PhasePotentials>(*update.potentials);
  if (fits) fit_potentials(grid, *potentials, foam.films, update.topology, foam.phases);
  result.project = interface::projection_onto(potentials);
  result.films = foam.films;
  meshing::MeshingParameters parameters = run_case.meshing;
  parameters.layer_width = layer_width(foam, update.topology);
  result.report = meshing::improve(result.films, result.project, grid.h(), parameters);
  if (fits) {
    fit_mesh(grid.h(), *potentials, result.project, foam.phases, result.films, result.report.n_off);
    result.largest_shift = largest_shift(*update.potentials, *potentials, update.topology);
  }
  result.topology = mesh::build_topology(result.films);
  result.report.after = mesh::measure_quality(result.films, result.topology);
  result.n_turned = meshing::count_turned(result.films, result.topology);
  result.seconds += processor_time() - start;
}

bool is_good(const DrainageMesh& mesh, const Case& run_case) {
  return mesh.report.after.smallest_angle_degrees >= run_case.meshing.smallest_angle_degrees &&
         mesh.n_turned == 0;
}

}  // namespace

DrainageMesh mesh_for_drainage(const grid::Grid& grid, const Case& run_case, state::Foam& foam,
                               std::vector<state::Event>& events) {
  DrainageMesh result;
  mesh_once(grid, run_case, foam, events, result);
  result.first_smallest_angle = result.report.after.smallest_angle_degrees;
  for (int time = 0; run_case.rearrangement.conserve_volumes && time < most_times; ++time) {
    if (is_good(result, run_case)) break;
    int n_steps = 0;
    const auto relaxed = equilibrate(grid, run_case, foam, events,
                                     [&](const auto&, const auto&) { return ++n_steps < steps_at_once; });
    result.n_relaxation_steps += n_steps;
    mesh_once(grid, run_case, foam, events, result);
    if (relaxed.converged) break;  // no T1 goes on
  }
  return result;
}

}  // namespace spume::simulation
