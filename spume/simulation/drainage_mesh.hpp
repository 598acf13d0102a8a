#pragma once

#include <vector>

#include "spume/mesh/remesh.hpp"
#include "spume/meshing/mesh_films.hpp"
#include "spume/simulation/film_update.hpp"

namespace spume::simulation {

/// A film mesh for drainage.
struct DrainageMesh {
  mesh::FilmMesh films;
  mesh::Topology topology;
  mesh::Projection project;         ///< onto the films that its vertices lie on
  meshing::MeshingReport report;    ///< of the mesh that was kept
  int n_turned = 0;                 ///< triangles, see meshing/figures.hpp
  FilmUpdate update;                ///< of the last reconstruction
  double largest_shift = 0;         ///< of films for the volumes of their bubbles [m]
  double seconds = 0;               ///< processor time for meshing, without reconstructions and relaxation
  int n_relaxation_steps = 0;       ///< by which a T1 was let go on
  double first_smallest_angle = 0;  ///< before that [degrees]
};

/// Reconstructs the films of a foam and makes the mesh for drainage of them (run_case.meshing); the foam gets
/// the reconstructed films, and keeps them.
///
/// Volumes: the films of a reconstruction enclose the bubbles' volumes to first order, which leaves several
/// per cent for bubbles of two cells' radius. The potentials are raised by one constant a bubble, by Newton's
/// method, before meshing and again for the finished mesh, whose vertices follow; what is left, some 1e-3 h,
/// mesh::restore_volumes() does. So vertices lie on smooth films, and flat triangles have the volumes.
///
/// T1s: a foam in the middle of a T1 may have a film much narrower than a cell that runs out into a wedge, of
/// which no mesh has good angles. Such a film opens or closes in a capillary time, while drainage takes
/// seconds: as long as the smallest angle is below run_case.meshing.smallest_angle_degrees, or a triangle is
/// turned, the films relax by five more steps without gas (equilibrate.hpp) and are meshed again, up to six
/// times or until they are at rest; the last mesh is kept, good or not, and the energy that the films lost is
/// part of the correction that meshing makes. Without rearrangement.conserve_volumes nothing is fitted or
/// relaxed. Events of the reconstructions go to `events`. Throws as reconstruct_films(). Collective.
DrainageMesh mesh_for_drainage(const grid::Grid& grid, const Case& run_case, state::Foam& foam,
                               std::vector<state::Event>& events);

}  // namespace spume::simulation
