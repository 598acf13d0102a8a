#pragma once

#include <vector>

#include "spume/grid/field.hpp"
#include "spume/grid/kernel_coupling.hpp"
#include "spume/grid/layer_window.hpp"
#include "spume/grid/sharpening.hpp"
#include "spume/mesh/film_mesh.hpp"
#include "spume/mesh/topology.hpp"
#include "spume/state/materials.hpp"

namespace spume::flow {

/// Film forces as the gas feels them.
struct FilmForces {
  std::vector<Vec3> on_vertex;   ///< what is left to move the films [N]
  std::vector<double> pressure;  ///< P_i of each phase, relative to the outside [Pa]
};

/// F_v = −2σ ∂A/∂x_v (every film once), less its pure-pressure part Σ_i P_i ∂V_i/∂x_v, and without what of
/// that pulls along films and borders, see take_out_sliding(). The tension is the same everywhere: no smooth
/// film pulls along itself. What ∂A/∂x_v has along it comes of the triangles, and would make the gas gather
/// the films' liquid around some vertices at any resolution; see docs/decisions/0003. Sum and moment of the
/// forces on each connected piece of the films stay as they are without that: zero, to round-off, for closed
/// ones.
FilmForces film_forces(const mesh::FilmMesh& films, const mesh::Topology& topology, int n_phases,
                       double surface_tension);

/// Brings film forces to the gas.
class ForceSpreader {
 public:
  explicit ForceSpreader(const grid::Grid& grid) : on_faces_(grid), window_(grid, 2) {}

  /// st_ζ of the paper's (7): vertex forces spread to faces by the kernel, sharpened, and brought to the
  /// centres of cells by wide_mean() [N/m³]. Overwrites `density`. Collective.
  void spread(const mesh::FilmMesh& films, const FilmForces& forces, const grid::KernelCoupling& kernel,
              grid::Sharpening& sharpening, grid::VectorField& density);

 private:
  grid::VectorField on_faces_;
  grid::LayerWindow window_;
};

}  // namespace spume::flow
