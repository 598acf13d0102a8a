#pragma once

#include <vector>

#include "spume/base/vec3.hpp"

/// Clusters of soap bubbles in equilibrium whose geometry is known in closed form. Films are spherical and
/// meet by threes at 120°, borders by fours at arccos(−1/3) (Plateau's laws); the pressure in a bubble of
/// outer radius r is 2T/r for films of tension T = 2σ (Young–Laplace with two faces).
namespace spume::verification {

/// A cluster of n equal bubbles, n = 1, 2, 3, 4, whose outer films have radius 1. Its bubbles are the power
/// cells of unit spheres whose centres are 1 apart.
struct EqualCluster {
  int n;
  double area;          ///< of all films
  double volume;        ///< of each bubble
  double inner_border;  ///< length of each border between three bubbles (n ≥ 3), else 0
  double outer_border;  ///< length of each border on the outside (n ≥ 2), else 0
  int n_inner_borders, n_outer_borders, n_lamellae, n_junctions;
  double outer_junction;  ///< distance of the outer junctions from the middle (n ≥ 3), else 0

  /// Length of all borders.
  double border_length() const { return n_inner_borders * inner_border + n_outer_borders * outer_border; }
  /// Outer radius of bubbles of the given volume.
  double radius_for(double bubble_volume) const;
};

/// Lengths by plane geometry of the circles in which the spheres meet, areas by the theorem of Gauss and
/// Bonnet, volumes by the virial identity Σ p_i V_i = (2/3) T A.
EqualCluster equal_cluster(int n);

/// Centres of the outer spheres for outer radius 1, the middle of the cluster at the origin. For n = 2 along
/// x, for n = 3 in the plane z = 0.
std::vector<Vec3> equal_cluster_centres(int n);

/// Two bubbles of any volumes: caps of radii r1 ≤ r2 whose centres are sqrt(r1² + r2² − r1 r2) apart and a
/// septum of curvature 1/r1 − 1/r2.
struct DoubleBubble {
  double radius_1, radius_2;  ///< of the outer films
  double septum_curvature;    ///< 1/r
  double distance;            ///< of the centres
  double volume_1, volume_2, area, border_length;
};

/// The double bubble with outer radii r1 ≤ r2 (any unit).
DoubleBubble double_bubble_of_radii(double radius_1, double radius_2);
/// The double bubble with volumes v1 ≤ v2; the ratio of radii by bisection to round-off.
DoubleBubble double_bubble_of_volumes(double volume_1, double volume_2);

/// Film area of the least cluster of five equal bubbles of volume V, over V^(2/3): by an independent
/// minimiser (Surface Evolver), to the digits given.
inline constexpr double five_bubble_area = 20.6322;

}  // namespace spume::verification
