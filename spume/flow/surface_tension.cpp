#include "spume/flow/surface_tension.hpp"

#include "spume/flow/film_pull.hpp"
#include "spume/flow/wide_mean.hpp"
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
  take_out_sliding(films, topology, forces.on_vertex);
  return forces;
}

void ForceSpreader::spread(const mesh::FilmMesh& films, const FilmForces& forces,
                           const grid::KernelCoupling& kernel, grid::Sharpening& sharpening,
                           grid::VectorField& density) {
  for (grid::Field& component : on_faces_.components) component.fill(0);
  kernel.spread(films.position, forces.on_vertex, on_faces_);
  sharpening.apply(on_faces_, kernel.placement);
  const grid::Grid& grid = density[0].grid();
  const Index3 n = grid.cells();
  for (int c = 0; c < 3; ++c) {
    double* to = density[c].values().data();
    window_.open(on_faces_[c], c);
    for (int k = grid.z_begin(); k < grid.z_end(); ++k) {
      window_.move_to(k);
      for (int j = 0; j < n.j; ++j, to += n.i) {
        const double *before = window_.row(j, k, c, -1), *lower = window_.row(j, k),
                     *upper = window_.row(j, k, c, 1), *after = window_.row(j, k, c, 2);
#pragma GCC ivdep
        for (int i = 0; i < n.i; ++i) to[i] = wide_mean(before[i], lower[i], upper[i], after[i]);
      }
    }
  }
}

}  // namespace spume::flow
