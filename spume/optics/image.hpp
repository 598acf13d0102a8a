#pragma once

#include <filesystem>
#include <vector>

#include "spume/optics/colour.hpp"

namespace spume::optics {

/// A picture; pixel (0, 0) is at the top left.
class Image {
 public:
  Image(int width, int height)
      : width_(width), height_(height), pixels_(static_cast<std::size_t>(width) * height) {}

  int width() const { return width_; }
  int height() const { return height_; }
  Colour& operator()(int x, int y) { return pixels_[static_cast<std::size_t>(y) * width_ + x]; }
  const Colour& operator()(int x, int y) const { return pixels_[static_cast<std::size_t>(y) * width_ + x]; }

 private:
  int width_, height_;
  std::vector<Colour> pixels_;
};

/// Writes a PNG with 8 bits a channel. Throws std::runtime_error when the file cannot be written.
void write_png(const Image& image, const std::filesystem::path& path);

}  // namespace spume::optics
