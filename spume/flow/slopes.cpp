#include "spume/flow/slopes.hpp"

#include <algorithm>
#include <cmath>

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
void row_of_slopes(std::ptrdiff_t n, std::ptrdiff_t s, const double* u, double* slope) {
#pragma GCC ivdep
  for (std::ptrdiff_t i = 0; i < n; ++i) {
    const double d_mm = u[i - s] - u[i - 2 * s];
    const double d_m = u[i] - u[i - s];
    const double d_p = u[i + s] - u[i];
    const double d_pp = u[i + 2 * s] - u[i + s];
    double below = 0.5 * (d_mm + d_m);
    double above = 0.5 * (d_p + d_pp);
    if constexpr (Limit) {
      below = limited(below, d_mm, d_m);
      above = limited(above, d_p, d_pp);
    }
    const double centred = (2.0 / 3) * (d_m + d_p) - (1.0 / 6) * (below + above);
    slope[i] = Limit ? limited(centred, d_m, d_p) : centred;
  }
}

}  // namespace

void slopes_of_row(std::ptrdiff_t n, std::ptrdiff_t stride, bool limit, const double* u, double* slope) {
  if (limit)
    row_of_slopes<true>(n, stride, u, slope);
  else
    row_of_slopes<false>(n, stride, u, slope);
}

void slopes(const BlockLayout& layout, const CellRange& range, int axis, bool limit, const double* u,
            double* slope) {
  for_each_row(layout, range, [&](std::ptrdiff_t row, std::ptrdiff_t n) {
    slopes_of_row(n, layout.stride(axis), limit, u + row, slope + row);
  });
}

}  // namespace spume::flow
