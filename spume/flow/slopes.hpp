#pragma once

#include "spume/flow/block.hpp"

namespace spume::flow {

/// Undivided fourth-order slopes h ∂u/∂x_axis of cell values along one axis (Colella, SIAM J. Sci. Stat.
/// Comput. 6 (1985) 104):
///   (4/3) Δu_i − (1/6) (δu_{i+1} + δu_{i−1}),   Δu_i = ½ (u_{i+1} − u_{i−1}),
/// with δu = Δu; when `limit`, δu is Δu limited to twice the smaller one-sided difference and zero at
/// extrema, and so is the result (monotone). Reads two cells beyond `range` along the axis.
void slopes(const BlockLayout& layout, const CellRange& range, int axis, bool limit, const double* u,
            double* slope);

/// The two stages of it for a row of n cells along x, neighbours along the axis `s` apart in u: δu of the
/// row, and the slopes from δu of the rows of neighbours below and above.
void central_differences(std::ptrdiff_t n, std::ptrdiff_t s, bool limit, const double* u, double* delta);
void slopes_from_differences(std::ptrdiff_t n, std::ptrdiff_t s, bool limit, const double* u,
                             const double* delta_below, const double* delta_above, double* slope);

}  // namespace spume::flow
