#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "spume/base/stage_times.hpp"
#include "spume/grid/grid.hpp"
#include "spume/mesh/film_mesh.hpp"
#include "spume/mesh/remesh.hpp"
#include "spume/mesh/topology.hpp"
#include "spume/state/phases.hpp"

namespace spume::interface {

/// Reconstruction of the film mesh by the Voronoi rule from smoothed indicators.
struct ReconstructParameters {
  double smoothing = 2.0;  ///< s/h², variance of the kernel
  double profile_floor =
      0.3;                  ///< the profile is continued linearly where its slope falls below this × maximum
  double relaxation = 0.4;  ///< time over which a new mesh relaxes [h²]; undone in advance for smooth shapes
  double smallest_bubble_cells = 2.5;  ///< pieces below (this × h)³ are not kept as bubbles of their own
  bool conserve_volumes = true;
  double edge = 1;  ///< target length of the edges of the new mesh [h]
  mesh::RemeshParameters remesh{.collapse_below = 0.6, .no_edge_beyond = 1.5, .merge_below = 0.3};
};

/// What a reconstruction did, for the log and for events.
struct ReconstructReport {
  int n_refused_projections = 0;  ///< on films and borders: Newton moves too long to believe (0 when healthy)
  int n_nonconforming_edges = 0;  ///< of the new mesh
  mesh::RemeshReport remesh;
  double largest_volume_displacement = 0;  ///< [m]
  struct PhaseChange {
    enum class Kind {
      Split,     ///< a piece of `phase` became the new phase `other`
      Pocket,    ///< an enclosed piece of the outside became the new phase `other`
      Absorbed,  ///< a piece of `phase` too small to keep was given to its neighbours (`other` is `phase`,
                 ///< which keeps its gas)
      Lost,  ///< the whole of `phase` was too small to keep; its gas went to `other`, the neighbour it shared
             ///< most film with
    } kind;
    mesh::Phase phase, other;
    double volume;  ///< [m³]
  };
  std::vector<PhaseChange> changes;
  StageTimes times;  ///< indicators, potentials, contour, projection, volumes, remesh, checks
};

/// Fields of the phases from which films can be found again; keeps what is needed to project points onto
/// them.
class PhasePotentials;

struct Reconstruction {
  mesh::FilmMesh films;
  mesh::Topology topology;  ///< of the films
  ReconstructReport report;
  std::shared_ptr<const PhasePotentials> potentials;
};

/// Rebuilds the film mesh. `phases` gains the bubbles that were born by splits, loses those that became too
/// small (target volume 0) and keeps the sum of target volumes of bubbles and pockets of the outside
/// consistent with that. Collective; every rank gets the same mesh. Throws NumericalError when a film comes
/// within four cells of a wall.
Reconstruction reconstruct(const grid::Grid& grid, const mesh::FilmMesh& films, state::Phases& phases,
                           const ReconstructParameters& parameters);
/// The same for films whose topology is known.
Reconstruction reconstruct(const grid::Grid& grid, const mesh::FilmMesh& films,
                           const mesh::Topology& topology, state::Phases& phases,
                           const ReconstructParameters& parameters);

/// The films of given potentials, which are the second half of reconstruct(): single pieces, contour,
/// projection, volumes, coarsening. The potentials are changed where pieces are separated, and by the
/// constants that give bubbles their volumes. `winners` as of find_winners(); `report` holds what was done
/// before. Throws as reconstruct().
Reconstruction extract_films(const grid::Grid& grid, std::shared_ptr<PhasePotentials> potentials,
                             std::vector<mesh::Phase> winners, state::Phases& phases,
                             const ReconstructParameters& parameters, ReconstructReport report);

/// Films from functions instead of from a mesh: the Voronoi interface of `potential(phase, x)`, phases 0 …
/// n−1 (where two are equal and largest; each smooth and of the size of a distance near its films). For
/// initial foams. The result is already reconstructed twice, which replaces the creases of the functions by
/// smooth films. Where a target volume in `phases` is 0 it is set to the volume found; a bubble that is
/// nowhere largest is reported Lost. Throws InputError when the films come within four cells of the edge of
/// the box.
Reconstruction construct(const grid::Grid& grid,
                         const std::function<double(mesh::Phase, const Vec3&)>& potential,
                         state::Phases& phases, const ReconstructParameters& parameters);

/// Projection onto the films of a reconstruction, for remeshing them to other targets.
mesh::Projection projection_onto(std::shared_ptr<const PhasePotentials> potentials);

}  // namespace spume::interface
