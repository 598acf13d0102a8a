#pragma once

#include "spume/mesh/phase_set.hpp"

namespace spume::optics {

/// Amounts of red, green and blue light, linear in energy, 1 for white.
struct Colour {
  double r = 0, g = 0, b = 0;

  constexpr Colour& operator+=(const Colour& c) {
    r += c.r;
    g += c.g;
    b += c.b;
    return *this;
  }
};
constexpr Colour operator+(Colour a, const Colour& b) {
  return a += b;
}
constexpr Colour operator*(double s, const Colour& c) {
  return {s * c.r, s * c.g, s * c.b};
}
/// a where t = 0, b where t = 1.
constexpr Colour mix(const Colour& a, const Colour& b, double t) {
  return (1 - t) * a + t * b;
}

/// From the numbers 0 … 255 of a screen (sRGB, IEC 61966-2-1).
Colour from_screen(int red, int green, int blue);
/// The number 0 … 255 of a screen for an amount of light; clipped.
int to_screen(double light);

/// Viridis (Smith & van der Walt 2015), dark blue at t = 0 to yellow at t = 1, even steps in perception;
/// clipped.
Colour viridis(double t);

/// A soft colour of its own for each bubble: hues a golden angle apart, so that neighbours in number differ.
Colour bubble_colour(mesh::Phase bubble);

}  // namespace spume::optics
