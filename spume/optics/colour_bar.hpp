#pragma once

#include <string>
#include <vector>

#include "spume/optics/image.hpp"
#include "spume/optics/render.hpp"

namespace spume::optics {

/// A mark of a logarithmic scale of lengths.
struct Tick {
  double value;      ///< [m]
  std::string text;  ///< with its unit: "200 nm", "1.5 µm"
};

/// Between two and about eight marks at round values inside the range.
std::vector<Tick> log_ticks(const ThicknessRange& range);

/// Where a value is on the logarithmic scale: 0 at the smallest, 1 at the largest.
double place_in(const ThicknessRange& range, double value);

/// Pixels at the right of a picture that the bar takes.
int colour_bar_width(int width, int height);
/// Draws the viridis scale of half-thickness with its marks at the right of the picture.
void draw_colour_bar(Image& image, const ThicknessRange& range);

}  // namespace spume::optics
