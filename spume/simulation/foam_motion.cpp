#include "spume/simulation/foam_motion.hpp"

#include <algorithm>
#include <utility>

#include "spume/flow/surface_tension.hpp"
#include "spume/interface/carry.hpp"
#include "spume/mesh/measure.hpp"
#include "spume/mesh/volume_constraint.hpp"

namespace spume::simulation {

FoamMotion::FoamMotion(const grid::Grid& grid, const Case& run_case, RunState& run)
    : grid_(grid),
      case_(run_case),
      run_(run),
      gas_(grid, run_case.materials.gas, run_case.flow),
      force_(grid),
      topology_(mesh::build_topology(run.foam.films)) {
  if (run.rearrange.reference.empty()) run.rearrange.reference = run.foam.films.position;
}

flow::StepLimit FoamMotion::choose_step() const {
  const auto& parameters = case_.rearrangement;
  const flow::StepLimit limits[] = {
      flow::capillary_limit(grid_.h(), case_.materials, parameters.capillary_factor),
      gas_.advection_limit(run_.foam.gas, parameters.cfl),
      {parameters.max_time - run_.rearrange.elapsed, "end of the stage"},
      {case_.cycle.end_time - run_.foam.time, "end of the run"}};
  return *std::min_element(std::begin(limits), std::end(limits),
                           [](const auto& a, const auto& b) { return a.dt < b.dt; });
}

double FoamMotion::largest_motion() const {
  double largest = 0;
  for (std::size_t v = 0; v < run_.rearrange.reference.size(); ++v)
    largest = std::max(largest, norm(run_.foam.films.position[v] - run_.rearrange.reference[v]));
  return largest;
}

bool FoamMotion::needs_reconstruction() const {
  const auto& parameters = case_.rearrangement;
  const double motion = largest_motion() / grid_.h();
  constexpr double moving = 0.25;  // a foam at rest is left alone: every reconstruction gives it a small kick
  return motion > parameters.reconstruction_displacement ||
         (run_.rearrange.steps_since_reconstruction >= parameters.reconstruction_interval && motion > moving);
}

FilmUpdate FoamMotion::reconstruct() {
  FilmUpdate update = reconstruct_films(grid_, case_, run_.foam);
  run_.rearrange.reference = run_.foam.films.position;
  run_.rearrange.steps_since_reconstruction = 0;
  topology_ = update.topology;
  return update;
}

MotionStep FoamMotion::step() {
  auto& foam = run_.foam;
  const double sigma = case_.materials.film.surface_tension;
  const auto forces = flow::film_forces(foam.films, topology_, foam.phases.count(), sigma);
  flow::spread_film_forces(foam.films, forces, kernel_, force_);

  MotionStep done{.limit = choose_step(), .events = {}};
  gas_.step(foam.gas, force_, done.limit.dt);
  interface::carry(foam.films, foam.gas.velocity, kernel_, done.limit.dt);
  foam.time += done.limit.dt;
  run_.rearrange.elapsed += done.limit.dt;
  ++run_.rearrange.steps_since_reconstruction;

  const double area_carried = mesh::film_area(foam.films);
  if (case_.rearrangement.conserve_volumes)
    mesh::restore_volumes(foam.films, foam.phases.target_volume, 1, 0.1 * grid_.h());
  if (needs_reconstruction()) {
    done.events = reconstruct().events;
    done.reconstructed = true;
  }
  transport::fill_young_films(foam.films, topology_, foam.liquid, grid_.h(), case_.transport);

  done.film_area = mesh::film_area(foam.films);
  done.kinetic_energy = flow::kinetic_energy(foam.gas, case_.materials.gas.density);
  done.correction = 2 * sigma * (done.film_area - area_carried);
  return done;
}

}  // namespace spume::simulation
