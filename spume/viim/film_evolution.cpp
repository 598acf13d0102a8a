#include "spume/viim/film_evolution.hpp"

#include <algorithm>
#include <memory>
#include <utility>

#include "spume/base/error.hpp"
#include "spume/interface/clearance.hpp"
#include "spume/interface/lost_bubbles.hpp"
#include "spume/mesh/topology.hpp"
#include "spume/viim/advance.hpp"
#include "spume/viim/closest_points.hpp"
#include "spume/viim/voronoi.hpp"

namespace spume::viim {

FilmEvolution::FilmEvolution(const grid::Grid& grid, const Parameters& parameters,
                             const mesh::FilmMesh& films, std::vector<mesh::Phase> phase_of_cell)
    : grid_(grid),
      parameters_(parameters),
      field_(distance_to(films, mesh::build_topology(films), grid.box(), std::move(phase_of_cell))) {}

interface::Reconstruction FilmEvolution::move(const mesh::FilmMesh& films, state::Phases& phases,
                                              const grid::VectorField& velocity,
                                              const grid::KernelCoupling& kernel, double dt,
                                              const interface::ReconstructParameters& parameters) {
  const double h = grid_.h(), epsilon = parameters_.epsilon * h;
  if (const auto problem = interface::edge_problem(grid_, films); !problem.empty())
    throw NumericalError(problem);
  const auto band = closest_points(films, grid_.box(), band_cells * h);
  const auto u = extension_velocity(band, velocity, kernel);
  advance(field_, band, u, dt);
  double fastest = 0;
  for (const Vec3& v : u) fastest = std::max(fastest, norm(v));
  displacement_ += fastest * dt;
  ++steps_;

  interface::ReconstructReport report;
  const bool lost = remove_lost_bubbles(films, phases, report.changes);
  auto potentials = std::make_shared<interface::PhasePotentials>(voronoi_potentials(field_, epsilon));
  auto winners = interface::find_winners(*potentials, grid_.communicator());
  auto result = interface::extract_films(grid_, std::move(potentials), std::move(winners), phases, parameters,
                                         std::move(report));
  const bool labels_agree = relabel(*result.potentials);
  if (lost || !labels_agree || !result.report.changes.empty() || steps_ >= parameters_.rebuild_interval ||
      displacement_ >= parameters_.rebuild_displacement * h) {
    field_ = distance_to(result.films, result.topology, *result.potentials);
    steps_ = 0;
    displacement_ = 0;
  }
  return result;
}

/// Takes bubbles without a core out of φ and χ, which are rebuilt from the mesh without them.
bool FilmEvolution::remove_lost_bubbles(const mesh::FilmMesh& films, state::Phases& phases,
                                        std::vector<interface::PhaseChange>& changes) {
  const auto lost = phases_without_core(field_, phases, parameters_.epsilon * grid_.h());
  if (lost.empty()) return false;
  mesh::FilmMesh left = films;
  for (mesh::Phase p : lost) {
    interface::remove_bubble(left, phases, p, changes);
    std::replace(field_.phase.begin(), field_.phase.end(), p, changes.back().other);
  }
  field_ = distance_to(left, mesh::build_topology(left), grid_.box(), std::move(field_.phase));
  return true;
}

/// χ becomes the winners. Where it changes φ turns its sign, so that the signed functions of the two phases
/// stay what they are. Gives whether φ is nowhere more than half a cell below zero then.
bool FilmEvolution::relabel(const interface::PhasePotentials& potentials) {
  const auto winners = interface::find_winners(potentials);
  const double lowest = -0.5 * grid_.h();
  bool agree = true;
  for (std::size_t c = 0; c < winners.size(); ++c) {
    if (winners[c] != field_.phase[c]) {
      field_.phase[c] = winners[c];
      field_.distance[c] = -field_.distance[c];
    }
    agree = agree && field_.distance[c] > lowest;
  }
  return agree;
}

}  // namespace spume::viim
