#include "spume/verification/foam_run.hpp"

#include <cmath>
#include <utility>

#include "spume/flow/surface_tension.hpp"
#include "spume/interface/reconstruct.hpp"
#include "spume/mesh/measure.hpp"
#include "spume/simulation/equilibrate.hpp"
#include "spume/simulation/initial_foam.hpp"
#include "spume/simulation/tear.hpp"

namespace spume::verification {

double Units::time() const {
  return std::sqrt(density * radius * radius * radius / tension);
}
double Units::speed() const {
  return std::sqrt(tension / (density * radius));
}
double Units::pressure() const {
  return tension / radius;
}

Units units_of_viscosity(double viscosity) {
  Units units{.radius = 1e-3, .tension = 0.06, .density = 1.2, .viscosity = 0};
  units.viscosity = viscosity * std::sqrt(units.density * units.tension * units.radius);
  return units;
}

Units units_of_laplace_number(double laplace) {
  return units_of_viscosity(std::sqrt(2 / laplace));
}

simulation::Case cube_case(const Units& units, int cells, double cells_per_radius) {
  simulation::Case c;
  const double half = 0.5 * cells / cells_per_radius * units.radius;
  c.box = {{-half, -half, -half}, {half, half, half}, {cells, cells, cells}};
  c.materials.gas = {.density = units.density, .viscosity = units.viscosity};
  c.materials.film.surface_tension = 0.5 * units.tension;
  c.rearrangement.max_time = 1e9;
  return c;
}

FoamRun::FoamRun(const parallel::Communicator& communicator, simulation::Case run_case)
    : case_(std::move(run_case)), grid_(communicator, case_.box), run_(grid_) {
  simulation::make_initial_foam(case_, run_.foam, events);
}

FoamRun::FoamRun(const parallel::Communicator& communicator, simulation::Case run_case, int n_bubbles,
                 const std::function<double(mesh::Phase, const Vec3&)>& potential)
    : case_(std::move(run_case)), grid_(communicator, case_.box), run_(grid_) {
  auto& foam = run_.foam;
  foam.phases.target_volume.assign(n_bubbles + 1, 0.0);
  foam.films = interface::construct(grid_, potential, foam.phases, case_.reconstruct).films;
  foam.liquid = transport::uniform_liquid(foam.films, mesh::build_topology(foam.films),
                                          case_.foam.lamella_half_thickness, case_.foam.border_area);
}

const mesh::Topology& FoamRun::topology() {
  topology_ = mesh::build_topology(run_.foam.films);
  return topology_;
}

simulation::FoamMotion& FoamRun::motion() {
  if (!motion_) motion_ = std::make_unique<simulation::FoamMotion>(grid_, case_, run_);
  return *motion_;
}

void FoamRun::forget_motion() {
  motion_.reset();
  run_.rearrange = {};
}

void FoamRun::move_until(double time, const std::function<bool(const simulation::MotionStep&)>& after_step) {
  case_.cycle.end_time = time;
  while (run_.foam.time < time) {
    const auto step = motion().step();
    events.insert(events.end(), step.events.begin(), step.events.end());
    if (after_step && !after_step(step)) return;
  }
}

void FoamRun::equilibrate() {
  simulation::equilibrate(grid_, case_, run_.foam, events, [](const auto&, const auto&) { return true; });
  forget_motion();
}

simulation::FilmUpdate FoamRun::reconstruct() {
  auto update = motion().reconstruct();
  events.insert(events.end(), update.events.begin(), update.events.end());
  return update;
}

simulation::FilmUpdate FoamRun::tear(mesh::Phase a, mesh::Phase b) {
  auto update = simulation::tear(grid_, case_, a, b, run_.foam);
  events.insert(events.end(), update.events.begin(), update.events.end());
  forget_motion();
  return update;
}

void FoamRun::accept_volumes() {
  auto& phases = run_.foam.phases;
  const auto volume = mesh::phase_volumes(run_.foam.films, phases.count());
  for (mesh::Phase p = 1; p < phases.count(); ++p)
    if (phases.alive(p)) phases.target_volume[p] = volume[p];
}

std::vector<double> bubble_pressures(FoamRun& run) {
  auto& foam = run.foam();
  return flow::film_forces(foam.films, run.topology(), foam.phases.count(),
                           run.run_case().materials.film.surface_tension)
      .pressure;
}

double virial_error(FoamRun& run) {
  auto& foam = run.foam();
  const auto pressure = bubble_pressures(run);
  const auto volume = mesh::phase_volumes(foam.films, foam.phases.count());
  double work = 0;
  for (mesh::Phase p = 1; p < foam.phases.count(); ++p) work += pressure[p] * volume[p];
  const double tension = 2 * run.run_case().materials.film.surface_tension;
  return std::abs(work / (2.0 / 3 * tension * mesh::film_area(foam.films)) - 1);
}

}  // namespace spume::verification
