#pragma once

#include <array>
#include <filesystem>
#include <optional>

#include "spume/optics/camera.hpp"
#include "spume/optics/image.hpp"
#include "spume/state/film_frame.hpp"

namespace spume::optics {

enum class Style {
  Bubbles,  ///< clear films with bright rims, each bubble in a soft colour of its own, borders as dark tubes
  Thickness,  ///< films coloured by their half-thickness on a logarithmic scale, with a colour bar
};

/// An interval of half-thickness [m].
struct ThicknessRange {
  double smallest, largest;
};

struct RenderOptions {
  Style style = Style::Bubbles;
  int width = 1000, height = 800;  ///< [pixels]
  int samples = 3;                 ///< rays along each side of a pixel
  Viewpoint viewpoint;
  bool label_time = true;  ///< the time of the frame in a corner
  std::optional<std::array<Vec3, 2>>
      view_box;                         ///< what the camera fits [m], for series; the films when not given
  std::optional<ThicknessRange> range;  ///< of the colours, for series; thickness_range() when not given
};

/// The half-thickness between which 99 % of the film points lie, at least a factor of 1.5 apart.
ThicknessRange thickness_range(const state::FilmFrame& frame);
/// Lower and upper corner of the films [m]; both at the origin when there are none.
std::array<Vec3, 2> bounds(const state::FilmFrame& frame);

/// A picture of the films. A ray gathers up to 16 films, front to back, each clear to a degree that falls
/// towards its rim as reflection at a film does; a Plateau border ends it. Borders are drawn with the area of
/// their cross-section, but at least 1.2 pixels thick. The same on any number of threads. Throws InputError
/// when the size is not positive.
Image render(const state::FilmFrame& frame, const RenderOptions& options);
/// The same into a PNG file. Throws std::runtime_error when it cannot be written.
void render(const state::FilmFrame& frame, const RenderOptions& options, const std::filesystem::path& path);

}  // namespace spume::optics
