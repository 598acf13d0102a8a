#include "spume/simulation/rearrange.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "spume/base/error.hpp"
#include "spume/flow/navier_stokes.hpp"
#include "spume/flow/surface_tension.hpp"
#include "spume/interface/carry.hpp"
#include "spume/mesh/measure.hpp"
#include "spume/mesh/volume_constraint.hpp"
#include "spume/simulation/equilibrate.hpp"
#include "spume/simulation/equilibrium.hpp"
#include "spume/simulation/film_update.hpp"

namespace spume::simulation {

namespace {

flow::StepLimit choose_step(const grid::Grid& grid, const Case& run_case, const flow::NavierStokes& gas,
                            const RunState& run) {
  const auto& parameters = run_case.rearrangement;
  const flow::StepLimit limits[] = {
      flow::capillary_limit(grid.h(), run_case.materials, parameters.capillary_factor),
      gas.advection_limit(run.foam.gas, parameters.cfl),
      {parameters.max_time - run.rearrange.elapsed, "end of the stage"},
      {run_case.cycle.end_time - run.foam.time, "end of the run"}};
  return *std::min_element(std::begin(limits), std::end(limits),
                           [](const auto& a, const auto& b) { return a.dt < b.dt; });
}

double largest_motion(const RunState& run) {
  double largest = 0;
  for (std::size_t v = 0; v < run.rearrange.reference.size(); ++v)
    largest = std::max(largest, norm(run.foam.films.position[v] - run.rearrange.reference[v]));
  return largest;
}

bool needs_reconstruction(const grid::Grid& grid, const RearrangementParameters& parameters,
                          const RunState& run) {
  const double motion = largest_motion(run) / grid.h();
  constexpr double moving = 0.25;  // a foam at rest is left alone: every reconstruction gives it a small kick
  return motion > parameters.reconstruction_displacement ||
         (run.rearrange.steps_since_reconstruction >= parameters.reconstruction_interval && motion > moving);
}

mesh::Topology reconstruct(const grid::Grid& grid, const Case& run_case, RunState& run, Witness& witness) {
  FilmUpdate update = reconstruct_films(grid, run_case, run.foam);
  witness.events(update.events);
  run.rearrange.reference = run.foam.films.position;
  run.rearrange.steps_since_reconstruction = 0;
  return std::move(update.topology);
}

/// Without gas: the overdamped motion of the films to equilibrium, at no cost of simulated time.
void rearrange_quasistatically(const grid::Grid& grid, const Case& run_case, RunState& run,
                               Witness& witness) {
  std::vector<state::Event> events;
  bool stopped = false;
  const auto report =
      equilibrate(grid, run_case, run.foam, events, [&](const auto&, const mesh::Topology& topology) {
        witness.step(run, topology, {}, "relaxation");
        return !(stopped = witness.stop_wanted());
      });
  witness.events(events);
  if (stopped) {
    witness.checkpoint(run);
    throw Interrupted("stopped in the relaxation; the state was saved");
  }
  witness.frame(run, mesh::build_topology(run.foam.films), run_case.output.rearrangement_interval);
  witness.event(run, report.converged ? "equilibrium reached" : "equilibrium not reached",
                fmt::format("quasistatic; {} steps; {}; last relative change of area {:.2g}", report.n_steps,
                            virial_text(report), report.area_change));
}

}  // namespace

void rearrange(const grid::Grid& grid, const Case& run_case, RunState& run, Witness& witness) {
  if (run_case.rearrangement.dynamics == RearrangementParameters::Dynamics::Quasistatic)
    return rearrange_quasistatically(grid, run_case, run, witness);

  const auto& materials = run_case.materials;
  const double window = equilibrium_window(run.foam.phases, materials);
  const grid::KernelCoupling kernel;
  flow::NavierStokes gas(grid, materials.gas, run_case.flow);
  grid::VectorField force(grid);
  mesh::Topology topology = mesh::build_topology(run.foam.films);
  if (run.rearrange.reference.empty()) run.rearrange.reference = run.foam.films.position;

  for (EquilibriumMeasure equilibrium;;) {
    const bool out_of_time =
        run.rearrange.elapsed >= run_case.rearrangement.max_time || run.foam.time >= run_case.cycle.end_time;
    if (equilibrium.reached(run_case.rearrangement.equilibrium_tolerance) || out_of_time) {
      witness.frame(run, topology, run_case.output.rearrangement_interval);
      witness.event(
          run, out_of_time ? "equilibrium not reached" : "equilibrium reached",
          run.rearrange.recent_time.empty()
              ? "no time for it"
              : fmt::format("after {:.4g} s; amplitude of motion {:.2g}; relative change of area {:.2g}",
                            run.rearrange.elapsed, equilibrium.amplitude, equilibrium.area_change));
      return;
    }
    if (run.foam.phases.n_bubbles() == 0) return;  // the last one was too small for the grid
    if (witness.stop_wanted()) {
      witness.checkpoint(run);
      throw Interrupted("stopped while the foam rearranged; the state was saved");
    }

    const auto forces =
        flow::film_forces(run.foam.films, topology, run.foam.phases.count(), materials.film.surface_tension);
    flow::spread_film_forces(run.foam.films, forces, kernel, force);
    const flow::StepLimit limit = choose_step(grid, run_case, gas, run);
    gas.step(run.foam.gas, force, limit.dt);
    interface::carry(run.foam.films, run.foam.gas.velocity, kernel, limit.dt);
    run.foam.time += limit.dt;
    run.rearrange.elapsed += limit.dt;
    ++run.rearrange.steps_since_reconstruction;
    const double area_carried = mesh::film_area(run.foam.films);
    if (run_case.rearrangement.conserve_volumes)
      mesh::restore_volumes(run.foam.films, run.foam.phases.target_volume, 1, 0.1 * grid.h());
    if (needs_reconstruction(grid, run_case.rearrangement, run))
      topology = reconstruct(grid, run_case, run, witness);
    transport::fill_young_films(run.foam.films, topology, run.foam.liquid, grid.h(), run_case.transport);

    const double sigma = materials.film.surface_tension;
    const double area = mesh::film_area(run.foam.films);
    const double kinetic_energy = flow::kinetic_energy(run.foam.gas, materials.gas.density);
    equilibrium = measure_equilibrium(run.rearrange, window, kinetic_energy, area, sigma);
    witness.step(run, topology,
                 {.dt = limit.dt,
                  .kinetic_energy = kinetic_energy,
                  .max_speed = flow::max_speed(run.foam.gas),
                  .correction = 2 * sigma * (area - area_carried)},
                 limit.reason);
    witness.frame_if_due(run, topology, run_case.output.rearrangement_interval);
    witness.checkpoint_if_due(run);
  }
}

}  // namespace spume::simulation
