#pragma once

#include "spume/verification/exact_clusters.hpp"
#include "spume/verification/foam_run.hpp"

namespace spume::verification {

/// The case with n equal spheres of radius `size` R whose centres are `spread` R apart (1 in equilibrium for
/// size 1), off the symmetric places of the grid.
simulation::Case with_cluster(simulation::Case of, const Units& units, int n, double spread = 1,
                              double size = 1);

/// Puts all vertices of a cluster made by with_cluster() with spread and size 1 onto the exact films, borders
/// and junctions for outer radius `radius` [m]; the volumes that result are the targets. Collective.
void put_onto_exact_cluster(FoamRun& run, double radius);

/// What a cluster near equilibrium is measured by, against the exact one of the same volumes.
struct ClusterErrors {
  double area;           ///< relative, of all films
  double border_length;  ///< relative, of all borders; 0 where there are none
  double inner_border;   ///< relative, of the borders between bubbles; 0 where there are none
  double pressure;       ///< relative, of the bubble that is farthest off
  double virial;         ///< |Σ p_i V_i / ((2/3) T A) − 1|
  double centre;         ///< of the inner junction of four bubbles from the middle [m], else 0
  double volume;         ///< relative, of the bubble that is farthest from its target
};

/// For equal bubbles (their mean target volume counts), n = 1, 2, 3, 4.
ClusterErrors errors_of_cluster(FoamRun& run, int n);

/// The middle of a cluster made by with_cluster().
Vec3 cluster_centre(const Units& units);

}  // namespace spume::verification
