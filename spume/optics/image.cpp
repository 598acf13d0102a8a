#include "spume/optics/image.hpp"

#include <fmt/format.h>
#include <png.h>

#include <stdexcept>

namespace spume::optics {

void write_png(const Image& image, const std::filesystem::path& path) {
  std::vector<png_byte> bytes;
  bytes.reserve(3 * static_cast<std::size_t>(image.width()) * image.height());
  for (int y = 0; y < image.height(); ++y)
    for (int x = 0; x < image.width(); ++x) {
      const Colour& c = image(x, y);
      for (double light : {c.r, c.g, c.b}) bytes.push_back(static_cast<png_byte>(to_screen(light)));
    }
  png_image header{};
  header.version = PNG_IMAGE_VERSION;
  header.width = static_cast<png_uint_32>(image.width());
  header.height = static_cast<png_uint_32>(image.height());
  header.format = PNG_FORMAT_RGB;
  const bool written = png_image_write_to_file(&header, path.c_str(), 0, bytes.data(), 0, nullptr) != 0;
  const std::string message = header.message;
  png_image_free(&header);
  if (!written)
    throw std::runtime_error(fmt::format("{}: cannot write the picture: {}", path.string(), message));
}

}  // namespace spume::optics
