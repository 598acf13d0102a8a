#pragma once

#include <vector>

#include "spume/grid/box.hpp"
#include "spume/simulation/case.hpp"

namespace spume::simulation {

/// A seeded cluster of spheres drawn together until they overlap enough to share films: random radii (normal,
/// cut at two standard deviations) and places; each is pulled to the middle and pushed out of others nearer
/// than 0.8 of the sum of radii. Scaled at the end so that the volume of the union is count × π d³/6.
/// Deterministic.
std::vector<BubbleShape> make_cluster(const ClusterShape& cluster, const grid::Box& box);

/// Potential of one bubble at x, of the size of a distance [m]: (r̄² / 2R̄)(1 − Σ (x_d/a_d)²), whose level set
/// 0 is the ellipsoid and whose ties with others of the same R̄ are power planes where both are spheres.
double power_potential(const BubbleShape& bubble, const Vec3& x, double mean_radius);

double equivalent_radius(const BubbleShape& bubble);          ///< of the sphere of the same volume [m]
double mean_radius(const std::vector<BubbleShape>& bubbles);  ///< of those spheres [m]

/// Cells of the box (i fastest) that lie outside all bubbles but are cut off from the edge of the box.
std::vector<char> enclosed_pockets(const std::vector<BubbleShape>& bubbles, const grid::Box& box);

}  // namespace spume::simulation
