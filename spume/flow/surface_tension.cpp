#include "spume/flow/surface_tension.hpp"

#include "spume/mesh/measure.hpp"

namespace spume::flow {

FilmForces film_forces(const mesh::FilmMesh& films, const mesh::Topology& topology, int n_phases,
                       double surface_tension) {
  const double tension = 2 * surface_tension;  // of a film, which has two faces [N/m]
  FilmForces forces{mesh::area_descent(films), {}};
  for (Vec3& f : forces.on_vertex) f *= tension;
  forces.pressure = mesh::film_pressures(films, topology, forces.on_vertex, n_phases);
  const std::vector<Vec3> of_pressure = mesh::weighted_volume_gradient(films, forces.pressure);
  for (std::size_t v = 0; v < of_pressure.size(); ++v) forces.on_vertex[v] += of_pressure[v];
  return forces;
}

void spread_film_forces(const mesh::FilmMesh& films, const FilmForces& forces,
                        const grid::KernelCoupling& kernel, grid::VectorField& density) {
  for (grid::Field& component : density.components) component.fill(0);
  kernel.spread(films.position, forces.on_vertex, density);
}

}  // namespace spume::flow
