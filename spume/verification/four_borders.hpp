#pragma once

#include <vector>

#include "spume/drainage/paper_border.hpp"
#include "spume/drainage/plateau_border.hpp"

/// The test problem of the paper's Sec. 4.3.2 and Fig. 10: four Plateau borders that meet at two junctions.
/// Borders 0, 1, 2 are half circles of radius 1, border 3 the straight line of length 2 between their ends.
/// The exact solution asks that gravity along the four borders sums to g at both junctions: border 2 bulges
/// along gravity, 0 and 1 across it. μ = σ = ρ = g = 1.
namespace spume::verification {

state::Materials four_borders_materials();

/// n equal edges on each border.
drainage::BorderCurves four_borders(int n);

/// The same as one network with one unknown a junction. unknown[b][i] is node i of border b.
struct SharedBorders {
  drainage::BorderNetwork network;
  std::vector<std::vector<int>> unknown;
};
SharedBorders share_junctions(const drainage::BorderCurves& borders);

/// λ of border b at arc length l and time t: three given functions, and the cubic in l that balances them.
double exact_border_area(int b, double l, double t);

/// The source that belongs to it.
/// Paper: Sec. 4.3.2, Eq. (18).
///   S = ∂λ/∂t + (C_Δ/μ) ∂/∂ℓ (−C₁ λ^{1/2} ∂λ/∂ℓ + λ² ρ g_τ),   g_τ = cos ℓ on border 2, 0 on the others
double exact_border_source(int b, double l, double t);

/// Largest nodal error and largest norm ‖·‖₂ of the piecewise linear error of a border, over all times.
struct BorderError {
  double largest = 0, norm = 0;
  double seconds = 0;  ///< processor time of the steps, without their source [s]
};

/// Table 3: error over 0 ≤ t ≤ 1 of the published scheme; before the projection at the junctions, which is
/// where the printed numbers were measured.
BorderError published_border_error(int n, int steps);
/// The same of the positive scheme.
BorderError positive_border_error(int n, int steps);

/// λ at t = 1 of the positive scheme on that problem.
std::vector<std::vector<double>> positive_border_end(int n, int steps);  ///< [border][node]

/// Nodal λ of all borders at the 32 times T/32, …, T that every run has.
using BorderHistory = std::vector<std::vector<std::vector<double>>>;  ///< [time][border][node]

/// Table 4: λ = 1 drains for 0 ≤ t ≤ 10 without source, by the published scheme, before the projection.
BorderHistory published_border_history(int n, int steps);
/// The same by the positive scheme.
BorderHistory positive_border_history(int n, int steps);
/// Liquid of the borders at each of those times [m³].
std::vector<double> border_liquid(const BorderHistory& history);
/// How far the run with n edges is from the one with 2n edges, on the nodes of the coarser.
BorderError border_difference(const BorderHistory& coarse, const BorderHistory& fine);

}  // namespace spume::verification
