#include "spume/interface/reconstruct.hpp"

#include <algorithm>
#include <optional>
#include <utility>

#include "spume/base/contract.hpp"
#include "spume/base/error.hpp"
#include "spume/interface/clearance.hpp"
#include "spume/interface/curved_triangles.hpp"
#include "spume/interface/find_films.hpp"
#include "spume/interface/grid_shift.hpp"
#include "spume/interface/indicators.hpp"
#include "spume/interface/lost_bubbles.hpp"
#include "spume/interface/potentials.hpp"
#include "spume/interface/relax.hpp"
#include "spume/interface/step_in_advance.hpp"
#include "spume/interface/volume_constants.hpp"
#include "spume/mesh/measure.hpp"
#include "spume/mesh/volume_constraint.hpp"

namespace spume::interface {

namespace {

constexpr double largest_volume_step = 0.2;  // of potentials and of vertices, in h

void require_clearance(const grid::Grid& grid, const mesh::FilmMesh& films) {
  if (const auto problem = clearance_problem(grid, films); !problem.empty()) throw NumericalError(problem);
}

PhasePotentials potentials_from(const grid::Grid& grid, mesh::FilmMesh films, const mesh::Topology& topology,
                                int n_phases, const ReconstructParameters& parameters, StageTimes& times) {
  const double h = grid.h(), variance = parameters.smoothing * h * h;
  step_in_advance(films, topology, variance / 10 + parameters.relaxation * h * h, h, n_phases);
  const ReconstructParameters known;  // the shift is that of these
  if (parameters.smoothing == known.smoothing && parameters.profile_floor == known.profile_floor)
    undo_grid_shift(grid, topology, films);
  const auto midpoints = edge_midpoints(films, topology);
  const PhaseBlocks blocks = blocks_of_phases(grid, films, n_phases);
  auto indicators = smoothed_indicators(grid, films, midpoints, blocks, variance);
  times.lap("indicators");
  PhasePotentials potentials =
      potentials_of(grid.box(), blocks.cells, std::move(indicators), variance, parameters.profile_floor);
  times.lap("potentials");
  return potentials;
}

/// Bubbles that smoothing has left with too few cells to be made whole again. A ball of the smallest volume
/// keeps 0.47 of it; only flat or long ones fall below a quarter.
std::vector<mesh::Phase> unresolved_bubbles(double h, const std::vector<mesh::Phase>& winners,
                                            const state::Phases& phases, double smallest_volume) {
  std::vector<double> volume(phases.count(), 0.0);
  for (mesh::Phase p : winners) volume[p] += h * h * h;
  std::vector<mesh::Phase> unresolved;
  for (mesh::Phase p = 1; p < phases.count(); ++p)
    if (phases.alive(p) && volume[p] < 0.25 * smallest_volume) unresolved.push_back(p);
  return unresolved;
}

/// Potentials, and their winners, of the films without the bubbles that are too small for the grid.
std::pair<PhasePotentials, std::vector<mesh::Phase>> potentials_of_resolved(
    const grid::Grid& grid, const mesh::FilmMesh& films, const mesh::Topology& topology,
    state::Phases& phases, const ReconstructParameters& parameters, double smallest_volume,
    ReconstructReport& report) {
  mesh::FilmMesh resolved = films;
  remove_small_bubbles(resolved, phases, smallest_volume, report.changes);
  std::optional<mesh::Topology> changed;
  if (!report.changes.empty()) changed = mesh::build_topology(resolved);
  for (;;) {
    PhasePotentials potentials = potentials_from(grid, resolved, changed ? *changed : topology,
                                                 phases.count(), parameters, report.times);
    auto winners = find_winners(potentials, grid.communicator());
    const auto unresolved = unresolved_bubbles(grid.h(), winners, phases, smallest_volume);
    report.times.lap("potentials");
    if (unresolved.empty()) return {std::move(potentials), std::move(winners)};
    for (mesh::Phase p : unresolved) remove_bubble(resolved, phases, p, report.changes);
    changed = mesh::build_topology(resolved);
  }
}

bool settles(const ReconstructParameters& parameters) {
  return parameters.relaxation > 0;
}

bool has_edge_below(const mesh::FilmMesh& films, double length) {
  const auto is_below = [&](int from, int to) {
    return norm_squared(films.edge(from, to)) < length * length;
  };
  return std::any_of(films.triangle.begin(), films.triangle.end(), [&](const mesh::FilmTriangle& t) {
    const auto& [a, b, c] = t.vertex;
    return is_below(a, b) || is_below(b, c) || is_below(c, a);
  });
}

/// Draws together what is no longer than merge_below edges.
void merge_tiny_edges(const parallel::Communicator& ranks, mesh::FilmMesh& films,
                      const ReconstructParameters& parameters, double h) {
  mesh::RemeshParameters merging = parameters.remesh;
  merging.collapse_below = merging.merge_below;
  merging.smoothing_sweeps = 0;
  const double edge_length = parameters.edge * h;
  if (!has_edge_below(films, merging.merge_below * edge_length)) return;
  const auto where_it_is = [](const Vec3& x, const mesh::PhaseSet&) { return std::optional(x); };
  mesh::remesh(
      films, [=](const Vec3&) { return edge_length; }, where_it_is, merging, ranks);
}

/// Relaxes a fresh mesh over a short time, by which the step in advance was longer: smooth shapes stay as
/// they are, while the kinks beside borders go and vertices settle in the discrete minimum of the area, above
/// which a fresh sampling of smooth films lies. What shrank to a point meanwhile is drawn together. Gives the
/// topology of the mesh.
mesh::Topology settle(const parallel::Communicator& ranks, mesh::FilmMesh& films, const state::Phases& phases,
                      const ReconstructParameters& parameters, double h) {
  constexpr int n_steps = 2;
  if (!settles(parameters) || films.triangle.empty()) return mesh::build_topology(films);
  const std::vector<double> volume =
      parameters.conserve_volumes ? phases.target_volume : mesh::phase_volumes(films, phases.count());
  relax_briefly(films, mesh::build_vertex_topology(films), phases.count(), parameters.relaxation * h * h,
                n_steps);
  merge_tiny_edges(ranks, films, parameters, h);
  // Volumes are good to a millionth by now, and two iterations make that 1e-9.
  mesh::restore_volumes(films, volume, 2, largest_volume_step * h);
  return mesh::build_topology(films);
}

}  // namespace

Reconstruction reconstruct(const grid::Grid& grid, const mesh::FilmMesh& films, state::Phases& phases,
                           const ReconstructParameters& parameters) {
  return reconstruct(grid, films, mesh::build_topology(films), phases, parameters);
}

Reconstruction reconstruct(const grid::Grid& grid, const mesh::FilmMesh& films,
                           const mesh::Topology& topology, state::Phases& phases,
                           const ReconstructParameters& parameters) {
  expects(topology.triangle_lamella.size() == films.triangle.size() &&
              topology.vertex_phases.size() == films.position.size(),
          "the topology is that of the films");
  const double h = grid.h(), edge = parameters.smallest_bubble_cells * h,
               smallest_volume = edge * edge * edge;
  ReconstructReport report;
  require_clearance(grid, films);
  auto [potentials, winners] =
      potentials_of_resolved(grid, films, topology, phases, parameters, smallest_volume, report);
  return extract_films(grid, std::make_shared<PhasePotentials>(std::move(potentials)), std::move(winners),
                       phases, parameters, std::move(report));
}

Reconstruction extract_films(const grid::Grid& grid, std::shared_ptr<PhasePotentials> potentials,
                             std::vector<mesh::Phase> winners, state::Phases& phases,
                             const ReconstructParameters& parameters, ReconstructReport report) {
  const double h = grid.h(), edge = parameters.smallest_bubble_cells * h,
               smallest_volume = edge * edge * edge;
  FoundFilms found = find_films(grid.communicator(), *potentials, std::move(winners), phases, smallest_volume,
                                report.changes);
  mesh::FilmMesh& mesh = found.films;
  report.times.lap("contour");
  report.n_refused_projections = project_vertices(grid.communicator(), *potentials, found.topology, mesh);
  report.times.lap("projection");
  if (parameters.conserve_volumes) {
    // The films move by some hundredths of h, and remeshing takes all other vertices along.
    raise_to_volumes(*potentials, mesh, phases, largest_volume_step * h);
    project_junctions(*potentials, found.topology, mesh);
  }
  report.times.lap("volumes");
  report.remesh = mesh::remesh(
      mesh, [edge_length = parameters.edge * h](const Vec3&) { return edge_length; },
      projection_onto(potentials), parameters.remesh, grid.communicator());
  report.times.lap("remesh");
  if (parameters.conserve_volumes)
    report.largest_volume_displacement = mesh::restore_volumes(
        mesh, phases.target_volume, settles(parameters) ? 1 : 3, largest_volume_step * h);
  report.times.lap("volumes");
  mesh::Topology topology = settle(grid.communicator(), mesh, phases, parameters, h);
  report.times.lap("settling");
  report.n_nonconforming_edges = topology.n_nonconforming_edges;
  require_clearance(grid, mesh);
  report.times.lap("checks");
  return {std::move(mesh), std::move(topology), std::move(report), std::move(potentials)};
}

mesh::Projection projection_onto(std::shared_ptr<const PhasePotentials> potentials) {
  return [potentials = std::move(potentials)](const Vec3& x, const mesh::PhaseSet& phases) {
    return potentials->project(x, phases);
  };
}

}  // namespace spume::interface
