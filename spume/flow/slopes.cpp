#include "spume/flow/slopes.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

namespace spume::flow {

namespace {

/// `slope` cut to twice the smaller of the differences to the two neighbours, zero where they disagree in
/// sign.
inline double limited(double slope, double below, double above) {
  const double bound = 2 * std::min(std::abs(below), std::abs(above));
  const double cut = std::max(-bound, std::min(bound, slope));
  return below * above > 0 ? cut : 0.0;
}

template <bool Limit>
void differences_of_row(std::ptrdiff_t n, std::ptrdiff_t s, const double* u, double* delta) {
#pragma GCC ivdep
  for (std::ptrdiff_t i = 0; i < n; ++i) {
    const double d_m = u[i] - u[i - s];
    const double d_p = u[i + s] - u[i];
    const double centred = 0.5 * (d_m + d_p);
    delta[i] = Limit ? limited(centred, d_m, d_p) : centred;
  }
}

template <bool Limit>
void slopes_of_row(std::ptrdiff_t n, std::ptrdiff_t s, const double* u, const double* below,
                   const double* above, double* slope) {
#pragma GCC ivdep
  for (std::ptrdiff_t i = 0; i < n; ++i) {
    const double d_m = u[i] - u[i - s];
    const double d_p = u[i + s] - u[i];
    const double centred = (2.0 / 3) * (d_m + d_p) - (1.0 / 6) * (below[i] + above[i]);
    slope[i] = Limit ? limited(centred, d_m, d_p) : centred;
  }
}

}  // namespace

void central_differences(std::ptrdiff_t n, std::ptrdiff_t s, bool limit, const double* u, double* delta) {
  if (limit)
    differences_of_row<true>(n, s, u, delta);
  else
    differences_of_row<false>(n, s, u, delta);
}

void slopes_from_differences(std::ptrdiff_t n, std::ptrdiff_t s, bool limit, const double* u,
                             const double* delta_below, const double* delta_above, double* slope) {
  if (limit)
    slopes_of_row<true>(n, s, u, delta_below, delta_above, slope);
  else
    slopes_of_row<false>(n, s, u, delta_below, delta_above, slope);
}

void slopes(const BlockLayout& layout, const CellRange& range, int axis, bool limit, const double* u,
            double* slope) {
  const std::ptrdiff_t s = layout.stride(axis);
  std::vector<double> below(range.upper.i - range.lower.i), above(below.size());
  for_each_row(layout, range, [&](std::ptrdiff_t row, std::ptrdiff_t n) {
    central_differences(n, s, limit, u + row - s, below.data());
    central_differences(n, s, limit, u + row + s, above.data());
    slopes_from_differences(n, s, limit, u + row, below.data(), above.data(), slope + row);
  });
}

}  // namespace spume::flow
