#include "spume/simulation/viim_motion.hpp"

#include <utility>

#include "spume/interface/carry.hpp"
#include "spume/io/rasterize.hpp"
#include "spume/mesh/measure.hpp"
#include "spume/simulation/film_update.hpp"

namespace spume::simulation {

ViimMotion::ViimMotion(const grid::Grid& grid, const Case& run_case, const state::Foam& foam)
    : case_(run_case),
      ranks_(grid.communicator()),
      h_(grid.h()),
      evolution_(grid,
                 {.epsilon = run_case.rearrangement.epsilon,
                  .rebuild_interval = run_case.rearrangement.reconstruction_interval,
                  .rebuild_displacement = run_case.rearrangement.reconstruction_displacement},
                 foam.films, io::rasterize_phases(foam.films, foam.phases.count(), grid.box())) {}

ViimStep ViimMotion::move(state::Foam& foam, const mesh::Topology& topology,
                          const grid::VectorField& velocity, const grid::KernelCoupling& kernel, double dt) {
  auto reconstruction = evolution_.move(foam.films, foam.phases, velocity, kernel, dt, case_.reconstruct);
  interface::carry(foam.films, velocity, kernel, dt);
  const double area_carried = mesh::film_area(foam.films);
  return {area_carried, take_over(ranks_, case_, h_, std::move(reconstruction), topology, foam)};
}

}  // namespace spume::simulation
