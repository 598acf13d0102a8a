#include "spume/optics/label.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

namespace spume::optics {

namespace {

/// A letter of 5 × 8 dots; bit r of a column is the dot in row r from the top. Row 6 is the base line.
struct Glyph {
  char letter;
  std::array<std::uint8_t, 5> column;
};

constexpr char micro = '\x01';  // stands for µ, which has two bytes in UTF-8

constexpr Glyph glyphs[] = {
    {'0', {0x3E, 0x41, 0x41, 0x41, 0x3E}}, {'1', {0x00, 0x42, 0x7F, 0x40, 0x00}},
    {'2', {0x42, 0x61, 0x51, 0x49, 0x46}}, {'3', {0x22, 0x41, 0x49, 0x49, 0x36}},
    {'4', {0x18, 0x14, 0x12, 0x7F, 0x10}}, {'5', {0x27, 0x45, 0x45, 0x45, 0x39}},
    {'6', {0x3C, 0x4A, 0x49, 0x49, 0x30}}, {'7', {0x01, 0x71, 0x09, 0x05, 0x03}},
    {'8', {0x36, 0x49, 0x49, 0x49, 0x36}}, {'9', {0x06, 0x49, 0x49, 0x29, 0x1E}},
    {'a', {0x20, 0x54, 0x54, 0x54, 0x78}}, {'b', {0x7F, 0x48, 0x44, 0x44, 0x38}},
    {'c', {0x38, 0x44, 0x44, 0x44, 0x28}}, {'d', {0x38, 0x44, 0x44, 0x48, 0x7F}},
    {'e', {0x38, 0x54, 0x54, 0x54, 0x18}}, {'f', {0x08, 0x7E, 0x09, 0x01, 0x02}},
    {'g', {0x18, 0xA4, 0xA4, 0xA4, 0x7C}}, {'h', {0x7F, 0x08, 0x04, 0x04, 0x78}},
    {'i', {0x00, 0x44, 0x7D, 0x40, 0x00}}, {'j', {0x40, 0x80, 0x84, 0x7D, 0x00}},
    {'k', {0x7F, 0x10, 0x28, 0x44, 0x00}}, {'l', {0x00, 0x41, 0x7F, 0x40, 0x00}},
    {'m', {0x7C, 0x04, 0x7C, 0x04, 0x78}}, {'n', {0x7C, 0x08, 0x04, 0x04, 0x78}},
    {'o', {0x38, 0x44, 0x44, 0x44, 0x38}}, {'p', {0xFC, 0x24, 0x24, 0x24, 0x18}},
    {'q', {0x18, 0x24, 0x24, 0x24, 0xFC}}, {'r', {0x7C, 0x08, 0x04, 0x04, 0x08}},
    {'s', {0x48, 0x54, 0x54, 0x54, 0x24}}, {'t', {0x04, 0x3F, 0x44, 0x40, 0x20}},
    {'u', {0x3C, 0x40, 0x40, 0x20, 0x7C}}, {'v', {0x1C, 0x20, 0x40, 0x20, 0x1C}},
    {'w', {0x3C, 0x40, 0x30, 0x40, 0x3C}}, {'x', {0x44, 0x28, 0x10, 0x28, 0x44}},
    {'y', {0x1C, 0xA0, 0xA0, 0xA0, 0x7C}}, {'z', {0x44, 0x64, 0x54, 0x4C, 0x44}},
    {'+', {0x08, 0x08, 0x3E, 0x08, 0x08}}, {'-', {0x00, 0x08, 0x08, 0x08, 0x00}},
    {'.', {0x00, 0x60, 0x60, 0x00, 0x00}}, {'=', {0x14, 0x14, 0x14, 0x14, 0x14}},
    {'/', {0x40, 0x30, 0x08, 0x06, 0x01}}, {'(', {0x00, 0x3C, 0x42, 0x81, 0x00}},
    {')', {0x00, 0x81, 0x42, 0x3C, 0x00}}, {micro, {0xFC, 0x40, 0x40, 0x20, 0x7C}},
};

constexpr double rows_of_capital = 7, space_between = 1.6, blank_width = 2.5;

struct Stroke {
  double x0, y0, x1, y1;  ///< in dots
};

/// The strokes of a text: neighbouring dots are joined, across a corner only where no dot fills it.
struct Strokes {
  std::vector<Stroke> strokes;
  double width = 0;  ///< in dots
};

void add_glyph(const Glyph& glyph, Strokes& text) {
  int first = 5, last = -1;
  for (int c = 0; c < 5; ++c)
    if (glyph.column[c] != 0) {
      first = std::min(first, c);
      last = c;
    }
  const auto dot = [&](int c, int r) {
    return c >= 0 && c < 5 && r >= 0 && r < 8 && (glyph.column[c] >> r & 1) != 0;
  };
  const auto add = [&](int c0, int r0, int c1, int r1) {
    text.strokes.push_back({text.width + c0 - first, r0 + 0.0, text.width + c1 - first, r1 + 0.0});
  };
  for (int c = first; c <= last; ++c)
    for (int r = 0; r < 8; ++r) {
      if (!dot(c, r)) continue;
      add(c, r, c, r);
      if (dot(c + 1, r)) add(c, r, c + 1, r);
      if (dot(c, r + 1)) add(c, r, c, r + 1);
      if (dot(c + 1, r + 1) && !dot(c + 1, r) && !dot(c, r + 1)) add(c, r, c + 1, r + 1);
      if (dot(c + 1, r - 1) && !dot(c + 1, r) && !dot(c, r - 1)) add(c, r, c + 1, r - 1);
    }
  text.width += last - first + space_between;
}

Strokes strokes_of(std::string_view text) {
  Strokes result;
  for (std::size_t n = 0; n < text.size(); ++n) {
    char letter = text[n];
    if (text.substr(n, 2) == "µ") {
      letter = micro;
      ++n;
    }
    if (letter == ' ') {
      result.width += blank_width;
      continue;
    }
    const auto* glyph = std::find_if(std::begin(glyphs), std::end(glyphs),
                                     [&](const Glyph& g) { return g.letter == letter; });
    if (glyph != std::end(glyphs)) add_glyph(*glyph, result);
  }
  return result;
}

double distance(const Stroke& s, double x, double y) {
  const double dx = s.x1 - s.x0, dy = s.y1 - s.y0, length_squared = dx * dx + dy * dy;
  const double t =
      length_squared > 0 ? std::clamp(((x - s.x0) * dx + (y - s.y0) * dy) / length_squared, 0.0, 1.0) : 0.0;
  return std::hypot(x - s.x0 - t * dx, y - s.y0 - t * dy);
}

}  // namespace

double label_width(std::string_view text, double height) {
  return (strokes_of(text).width - space_between + 1) * height / rows_of_capital;
}

void draw_label(Image& image, std::string_view text, double x, double y, double height,
                const Colour& colour) {
  const Strokes label = strokes_of(text);
  const double dot = height / rows_of_capital, half_stroke = std::max(0.42 * dot, 0.5);
  const double left = x + 0.5 * dot,
               top = y - 3 * dot;  // of the middle of dot (0, 0); row 3 is the middle of a capital
  const int x_end = std::min(image.width(), static_cast<int>(left + label.width * dot) + 2);
  const int y_end = std::min(image.height(), static_cast<int>(top + 8 * dot) + 2);
  for (int py = std::max(0, static_cast<int>(top - dot) - 1); py < y_end; ++py)
    for (int px = std::max(0, static_cast<int>(x) - 1); px < x_end; ++px) {
      double nearest = 1e9;
      for (const Stroke& stroke : label.strokes)
        nearest = std::min(nearest, distance(stroke, (px + 0.5 - left) / dot, (py + 0.5 - top) / dot));
      const double cover = std::clamp(half_stroke + 0.5 - nearest * dot, 0.0, 1.0);
      image(px, py) = mix(image(px, py), colour, cover);
    }
}

}  // namespace spume::optics
