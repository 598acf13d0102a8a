#pragma once

#include <string_view>

#include "spume/optics/image.hpp"

namespace spume::optics {

/// Width of a text drawn with letters of the given height [pixels].
double label_width(std::string_view text, double height);

/// Draws a text with its left end at x and the middle of its letters at y [pixels]. Knows digits, small
/// letters, µ and
/// + - . = / ( ) and blanks; skips everything else.
void draw_label(Image& image, std::string_view text, double x, double y, double height, const Colour& colour);

}  // namespace spume::optics
