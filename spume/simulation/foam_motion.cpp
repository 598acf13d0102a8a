#include "spume/simulation/foam_motion.hpp"

#include <algorithm>
#include <utility>

#include "spume/interface/carry.hpp"
#include "spume/mesh/measure.hpp"
#include "spume/mesh/volume_constraint.hpp"
#include "spume/simulation/equilibrium.hpp"

namespace spume::simulation {

FoamMotion::FoamMotion(const grid::Grid& grid, const Case& run_case, RunState& run)
    : grid_(grid),
      case_(run_case),
      run_(run),
      sharpening_(grid),
      gas_(grid, run_case.materials.gas, run_case.flow),
      spreader_(grid),
      force_(grid),
      film_velocity_(grid),
      topology_(mesh::build_topology(run.foam.films)) {
  if (run.rearrange.reference.empty()) run.rearrange.reference = run.foam.films.position;
  if (run_case.rearrangement.interface == RearrangementParameters::Interface::Viim)
    viim_.emplace(grid, run_case, run.foam);
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

/// Vertices drift within films and along borders that are at rest: that does not count here.
double FoamMotion::largest_normal_motion() const {
  const auto& films = run_.foam.films;
  const std::vector<Vec3> normal = mesh::doubled_vertex_normals(films),
                          tangent = mesh::border_tangents(films, topology_);
  double largest = 0;
  for (std::size_t v = 0; v < run_.rearrange.reference.size(); ++v) {
    const Vec3 motion = films.position[v] - run_.rearrange.reference[v];
    const Vec3 n = normalized(normal[v]);
    const Vec3& t = tangent[v];
    double across = norm(motion);
    if (topology_.vertex_kind[v] == mesh::VertexKind::Film) across = std::abs(dot(motion, n));
    if (topology_.vertex_kind[v] == mesh::VertexKind::Border) across = norm(motion - dot(motion, t) * t);
    largest = std::max(largest, across);
  }
  return largest;
}

bool FoamMotion::needs_reconstruction() const {
  const auto& parameters = case_.rearrangement;
  const double motion = mesh::largest_distance(run_.rearrange.reference, run_.foam.films.position);
  if (motion > parameters.reconstruction_displacement * grid_.h()) return true;
  constexpr double moving = 0.25;  // a foam at rest is left alone: every reconstruction gives it a small kick
  return run_.rearrange.steps_since_reconstruction >= parameters.reconstruction_interval &&
         largest_normal_motion() > moving * grid_.h();
}

FilmUpdate FoamMotion::reconstruct() {
  const double start = processor_time();
  FilmUpdate update = reconstruct_films(grid_, case_, topology_, run_.foam);
  double inside = 0;
  for (const auto& [stage, seconds] : update.reconstruction.times.seconds()) {
    reconstruction_times_.add(stage, seconds);
    inside += seconds;
  }
  reconstruction_times_.add("liquid transfer", processor_time() - start - inside);
  run_.rearrange.reference = run_.foam.films.position;
  run_.rearrange.steps_since_reconstruction = 0;
  topology_ = update.topology;
  return update;
}

/// Moves the films with the gas, restores their volumes and reconstructs them where that is due. Gives their
/// area before corrections [m²].
double FoamMotion::carry_films(double dt, std::vector<state::Event>& events) {
  auto& foam = run_.foam;
  gas_.film_velocity(foam.gas, film_velocity_);
  times_.lap("gas");
  sharpening_.apply(film_velocity_);
  if (viim_) {
    ViimStep moved = viim_->move(foam, topology_, film_velocity_, kernel_, dt);
    topology_ = std::move(moved.update.topology);
    events = std::move(moved.update.events);
    run_.rearrange.reference = foam.films.position;
    run_.rearrange.steps_since_reconstruction = 0;
    return moved.area_carried;
  }
  interface::carry(foam.films, film_velocity_, kernel_, dt);
  times_.lap("moving films");
  ++run_.rearrange.steps_since_reconstruction;
  const double area_carried = mesh::film_area(foam.films);
  if (case_.rearrangement.conserve_volumes)
    mesh::restore_volumes(foam.films, foam.phases.target_volume, 1, 0.1 * grid_.h());
  times_.lap("volumes");
  if (needs_reconstruction()) events = reconstruct().events;
  return area_carried;
}

MotionStep FoamMotion::step() {
  auto& foam = run_.foam;
  const double sigma = case_.materials.film.surface_tension;
  times_.restart();
  const auto forces = flow::film_forces(foam.films, topology_, foam.phases.count(), sigma);
  times_.lap("film forces");
  spreader_.spread(foam.films, forces, kernel_, sharpening_, force_);
  times_.lap("spreading");

  MotionStep done{.limit = choose_step(), .events = {}};
  done.virial = virial_ratio(foam.films, foam.phases, forces.pressure, mesh::film_area(foam.films), sigma);
  times_.lap("time step and virial");
  gas_.step(foam.gas, force_, done.limit.dt);
  times_.lap("gas");
  const double area_carried = carry_films(done.limit.dt, done.events);
  foam.time += done.limit.dt;
  run_.rearrange.elapsed += done.limit.dt;
  done.reconstructed = run_.rearrange.steps_since_reconstruction == 0;
  times_.restart();
  transport::fill_young_films(foam.films, topology_, foam.liquid, grid_.h(), case_.transport);
  times_.lap("young films");

  done.film_area = mesh::film_area(foam.films);
  done.kinetic_energy = flow::kinetic_energy(foam.gas, case_.materials.gas.density);
  done.correction = 2 * sigma * (done.film_area - area_carried);
  times_.lap("measures");
  return done;
}

}  // namespace spume::simulation
