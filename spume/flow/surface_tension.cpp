#include "spume/flow/surface_tension.hpp"

#include "spume/flow/film_pull.hpp"
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
    ghosted_.update(on_faces_[c]);
    const std::ptrdiff_t up = c == 0 ? 1 : c == 1 ? ghosted_.stride_y() : ghosted_.stride_z();
    const bool walled = grid.box().boundary[c] != grid::Boundary::Periodic;
    double* to = density[c].values().data();
    for (int k = grid.z_begin(); k < grid.z_end(); ++k)
      for (int j = 0; j < n.j; ++j, to += n.i) {
        const double* face = ghosted_.at(0, j, k);
        for (int i = 0; i < n.i; ++i) to[i] = 0.5 * (face[i] + face[i + up]);
        // The upper face of the last cell is the wall, not the mirror image of the lower one.
        if (walled && c == 0) to[n.i - 1] = 0.5 * face[n.i - 1];
        if (walled && ((c == 1 && j == n.j - 1) || (c == 2 && k == n.k - 1)))
          for (int i = 0; i < n.i; ++i) to[i] = 0.5 * face[i];
      }
  }
}

}  // namespace spume::flow
