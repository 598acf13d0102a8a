#include "spume/optics/colour_bar.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "spume/optics/label.hpp"

namespace spume::optics {

namespace {

/// Height of letters [pixels].
double letter_height(int height) {
  return std::max(9.0, height / 55.0);
}

std::string length_text(double metres) {
  struct Unit {
    const char* name;
    double size;
  };
  constexpr Unit units[] = {{"mm", 1e-3}, {"µm", 1e-6}, {"nm", 1e-9}};
  for (const Unit& unit : units)
    // A hair below, so that 1e-6 stored as 0.99999…e-6 is 1 µm and not 1000 nm.
    if (metres >= 0.9999 * unit.size || &unit == std::end(units) - 1)
      return fmt::format("{:.3g} {}", metres / unit.size, unit.name);
  return {};
}

std::vector<double> multiples(const ThicknessRange& range, std::initializer_list<int> digits) {
  std::vector<double> values;
  const int first = static_cast<int>(std::floor(std::log10(range.smallest)));
  const int last = static_cast<int>(std::ceil(std::log10(range.largest)));
  for (int decade = first; decade <= last; ++decade)
    for (int digit : digits) {
      const double value = digit * std::pow(10.0, decade);
      if (value >= range.smallest * 0.9999 && value <= range.largest * 1.0001) values.push_back(value);
    }
  return values;
}

std::vector<double> even_steps(const ThicknessRange& range) {
  const double rough = (range.largest - range.smallest) / 4;
  const double decade = std::pow(10.0, std::floor(std::log10(rough)));
  const double step = decade * (rough < 2 * decade ? 1 : rough < 5 * decade ? 2 : 5);
  std::vector<double> values;
  for (double n = std::ceil(range.smallest / step); n * step <= range.largest; ++n)
    values.push_back(n * step);
  return values;
}

}  // namespace

std::vector<Tick> log_ticks(const ThicknessRange& range) {
  std::vector<double> values = multiples(range, {1});
  if (values.size() < 4) values = multiples(range, {1, 2, 5});
  if (values.size() < 3) values = even_steps(range);
  std::vector<Tick> ticks;
  for (double value : values) ticks.push_back({value, length_text(value)});
  return ticks;
}

double place_in(const ThicknessRange& range, double value) {
  return std::log(value / range.smallest) / std::log(range.largest / range.smallest);
}

int colour_bar_width(int width, int height) {
  return std::min(width / 3, static_cast<int>(11 * letter_height(height)));
}

void draw_colour_bar(Image& image, const ThicknessRange& range) {
  const double letter = letter_height(image.height());
  const int left =
      image.width() - colour_bar_width(image.width(), image.height()) + static_cast<int>(2.2 * letter);
  const int right = left + static_cast<int>(1.6 * letter);
  const int top = static_cast<int>(0.18 * image.height()), bottom = static_cast<int>(0.86 * image.height());
  const Colour ink = from_screen(50, 58, 70);
  for (int y = top; y < bottom; ++y)
    for (int x = left; x < right; ++x) image(x, y) = viridis((bottom - y - 0.5) / (bottom - top));
  for (const Tick& tick : log_ticks(range)) {
    const double y = bottom - place_in(range, tick.value) * (bottom - top);
    const int row = std::clamp(static_cast<int>(y), top, bottom - 1);
    for (int x = right; x < right + static_cast<int>(0.5 * letter); ++x) image(x, row) = ink;
    draw_label(image, tick.text, right + 0.8 * letter, row + 0.5, letter, ink);
  }
  const std::string_view title = "half-thickness";
  const double title_left = std::min(left + 0.0, image.width() - label_width(title, letter) - 0.5 * letter);
  draw_label(image, title, title_left, top - 1.8 * letter, letter, ink);
}

}  // namespace spume::optics
