#include "spume/optics/colour.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace spume::optics {

namespace {

double linear(double screen) {
  return screen <= 0.04045 ? screen / 12.92 : std::pow((screen + 0.055) / 1.055, 2.4);
}

}  // namespace

Colour from_screen(int red, int green, int blue) {
  return {linear(red / 255.0), linear(green / 255.0), linear(blue / 255.0)};
}

int to_screen(double light) {
  const double x = std::clamp(light, 0.0, 1.0);
  const double screen = x <= 0.0031308 ? 12.92 * x : 1.055 * std::pow(x, 1 / 2.4) - 0.055;
  return static_cast<int>(255 * screen + 0.5);
}

Colour viridis(double t) {
  static constexpr std::array<std::array<int, 3>, 11> knots{{{68, 1, 84},
                                                             {72, 36, 117},
                                                             {65, 68, 135},
                                                             {53, 95, 141},
                                                             {42, 120, 142},
                                                             {33, 145, 140},
                                                             {34, 168, 132},
                                                             {68, 191, 112},
                                                             {122, 209, 81},
                                                             {189, 223, 38},
                                                             {253, 231, 37}}};
  const double x = std::clamp(t, 0.0, 1.0) * (knots.size() - 1);
  const auto n = std::min(static_cast<std::size_t>(x), knots.size() - 2);
  const auto at = [](const std::array<int, 3>& c) { return from_screen(c[0], c[1], c[2]); };
  return mix(at(knots[n]), at(knots[n + 1]), x - static_cast<double>(n));
}

Colour bubble_colour(mesh::Phase bubble) {
  // OKLCH (Ottosson 2020): hue h at one lightness L and chroma C, so that no bubble stands out.
  constexpr double golden_angle = std::numbers::pi * (3 - 2.23606797749979);
  constexpr double lightness = 0.78, chroma = 0.11;
  const double hue = 4.2 + golden_angle * bubble;
  const double a = chroma * std::cos(hue), b = chroma * std::sin(hue);
  const auto cube = [](double x) { return x * x * x; };
  const double l = cube(lightness + 0.3963377774 * a + 0.2158037573 * b);
  const double m = cube(lightness - 0.1055613458 * a - 0.0638541728 * b);
  const double s = cube(lightness - 0.0894841775 * a - 1.2914855480 * b);
  return {std::max(0.0, 4.0767416621 * l - 3.3077115913 * m + 0.2309699292 * s),
          std::max(0.0, -1.2684380046 * l + 2.6097574011 * m - 0.3413193965 * s),
          std::max(0.0, -0.0041960863 * l - 0.7034186147 * m + 1.7076147010 * s)};
}

}  // namespace spume::optics
