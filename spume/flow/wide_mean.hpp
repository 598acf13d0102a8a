#pragma once

namespace spume::flow {

/// Value between b and c of four values a, b, c, d in a row, one cell apart, from cells to faces and from
/// faces to cells: (7 (b + c) − (a + d))/12. Of means over cells it is the value at the place between, to
/// fourth order; a wave of phase advance θ a cell it multiplies by
///   cos(θ/2) (4 − cos θ)/3 = 1 + θ²/24 + O(θ⁴).
/// The plain mean of b and c smooths by −θ²/8, and makes a pressure gradient miss the direction of short
/// waves; see docs/decisions/0005.
inline double wide_mean(double a, double b, double c, double d) {
  return (7.0 / 12) * (b + c) - (1.0 / 12) * (a + d);
}

/// Difference of the wide means on both sides of the middle of five values in a row, which the middle one
/// drops out of: (8 (d − b) − (e − a))/12 of a, b, ·, d, e. Over the width of a cell it is the derivative to
/// fourth order, sin θ (4 − cos θ)/3 = θ + O(θ⁵).
inline double wide_difference(double a, double b, double d, double e) {
  return (2.0 / 3) * (d - b) - (1.0 / 12) * (e - a);
}

}  // namespace spume::flow
