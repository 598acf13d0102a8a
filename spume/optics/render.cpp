#include "spume/optics/render.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <numbers>
#include <string>
#include <thread>
#include <vector>

#include "spume/base/error.hpp"
#include "spume/optics/colour_bar.hpp"
#include "spume/optics/label.hpp"
#include "spume/optics/shading.hpp"
#include "spume/optics/tracer.hpp"

namespace spume::optics {

namespace {

constexpr int most_films = 16;
constexpr double thinnest_border = 1.2;  // pixels

/// Area-weighted unit normal of each film point; creases stay, because points are separate where lamellae
/// meet.
std::vector<Vec3> point_normals(const state::FilmFrame& frame) {
  std::vector<Vec3> normal(frame.film_point.size());
  for (const auto& triangle : frame.triangle) {
    const auto& [a, b, c] = triangle.point;
    const Vec3 n =
        cross(frame.film_point[b] - frame.film_point[a], frame.film_point[c] - frame.film_point[a]);
    for (int p : triangle.point) normal[p] += n;
  }
  for (Vec3& n : normal) n = normalized(n);
  return normal;
}

std::vector<Vec3> corners_of(const std::array<Vec3, 2>& box) {
  std::vector<Vec3> corners;
  for (int n = 0; n < 8; ++n) corners.push_back({box[n & 1].x, box[n >> 1 & 1].y, box[n >> 2].z});
  return corners;
}

/// All that rays need to know of a picture. The foam fills the part of the picture that no colour bar takes.
class Painter {
 public:
  Painter(const state::FilmFrame& frame, const RenderOptions& options)
      : frame_(frame),
        options_(options),
        range_(options.range.value_or(thickness_range(frame))),
        foam_width_(options.width - (options.style == Style::Thickness
                                         ? colour_bar_width(options.width, options.height)
                                         : 0)),
        camera_(options.view_box ? corners_of(*options.view_box) : frame.film_point, options.viewpoint,
                static_cast<double>(foam_width_) / options.height),
        tracer_(frame, border_radii()),
        normal_(point_normals(frame)) {}

  Colour pixel(int x, int y) const {
    const int n = options_.samples;
    Colour sum;
    for (int j = 0; j < n; ++j)
      for (int i = 0; i < n; ++i)
        sum += ray((x + (i + 0.5) / n) / foam_width_, (y + (j + 0.5) / n) / options_.height);
    return 1.0 / (n * n) * sum;
  }
  const ThicknessRange& range() const { return range_; }

 private:
  std::vector<double> border_radii() const;
  Colour ray(double x, double y) const;
  Surface surface(const Hit& hit, const Vec3& direction) const;
  Colour thickness_colour(const state::FilmFrame::Triangle& triangle,
                          const std::array<double, 3>& weight) const;

  const state::FilmFrame& frame_;
  const RenderOptions& options_;
  ThicknessRange range_;
  int foam_width_;  // pixels
  Camera camera_;
  Tracer tracer_;
  std::vector<Vec3> normal_;
};

/// Of a round tube with the cross-section of the border, or of a tube just wide enough to see.
std::vector<double> Painter::border_radii() const {
  std::vector<double> radius;
  for (std::size_t p = 0; p < frame_.border_point.size(); ++p) {
    const double depth = -dot(frame_.border_point[p] - camera_.eye(), camera_.backward());
    const double pixel = camera_.height_at_unit_distance() * depth / options_.height;
    const double exact = std::sqrt(std::max(0.0, frame_.border_area[p]) / std::numbers::pi);
    radius.push_back(std::max(exact, 0.5 * thinnest_border * pixel));
  }
  return radius;
}

Colour Painter::ray(double x, double y) const {
  const Vec3 direction = camera_.direction(x, y);
  std::array<Hit, most_films> hits;
  const int n = tracer_.trace(camera_.eye(), direction, hits);
  Colour gathered;
  double clear = 1;  // what is left for the surfaces behind
  for (int h = 0; h < n && clear > 0.002; ++h) {
    const Surface met = surface(hits[h], direction);
    gathered += clear * met.light;
    clear *= 1 - met.cover;
  }
  return gathered + clear * background(y);
}

Surface Painter::surface(const Hit& hit, const Vec3& direction) const {
  if (hit.triangle < 0) return border_tube(hit.normal, direction, camera_);
  const auto& triangle = frame_.triangle[hit.triangle];
  Vec3 normal;
  for (int c = 0; c < 3; ++c) normal += hit.weight[c] * normal_[triangle.point[c]];
  normal = normalized(normal);
  if (options_.style == Style::Thickness)
    return painted_film(thickness_colour(triangle, hit.weight), normal, direction, 0.75);
  if (triangle.phase_a == 0)
    return clear_film(bubble_colour(triangle.phase_b), normal, direction, camera_, 1);
  const Colour tint = mix(bubble_colour(triangle.phase_a), bubble_colour(triangle.phase_b), 0.5);
  return clear_film(tint, normal, direction, camera_, 0.8);
}

Colour Painter::thickness_colour(const state::FilmFrame::Triangle& triangle,
                                 const std::array<double, 3>& weight) const {
  double eta = 0;
  for (int c = 0; c < 3; ++c) eta += weight[c] * frame_.half_thickness[triangle.point[c]];
  return viridis(place_in(range_, std::max(eta, range_.smallest)));
}

std::string time_text(double seconds) {
  if (seconds == 0 || seconds >= 0.1) return fmt::format("t = {:.4g} s", seconds);
  if (seconds >= 1e-4) return fmt::format("t = {:.4g} ms", 1e3 * seconds);
  return fmt::format("t = {:.4g} µs", 1e6 * seconds);
}

void paint_rows(const Painter& painter, Image& image) {
  std::atomic<int> next_row = 0;
  const auto work = [&] {
    for (int y = next_row++; y < image.height(); y = next_row++)
      for (int x = 0; x < image.width(); ++x) image(x, y) = painter.pixel(x, y);
  };
  std::vector<std::jthread> others;
  for (unsigned n = 1; n < std::thread::hardware_concurrency(); ++n) others.emplace_back(work);
  work();
}

}  // namespace

ThicknessRange thickness_range(const state::FilmFrame& frame) {
  std::vector<double> eta;
  for (double value : frame.half_thickness)
    if (value > 0 && std::isfinite(value)) eta.push_back(value);
  if (eta.empty()) return {1e-7, 1e-5};
  std::sort(eta.begin(), eta.end());
  const std::size_t cut = eta.size() / 200;
  const double smallest = eta[cut], largest = eta[eta.size() - 1 - cut];
  const double widen = std::max(1.0, std::sqrt(1.5 * smallest / largest));
  return {smallest / widen, largest * widen};
}

std::array<Vec3, 2> bounds(const state::FilmFrame& frame) {
  if (frame.film_point.empty()) return {};
  std::array<Vec3, 2> box{frame.film_point[0], frame.film_point[0]};
  for (const Vec3& x : frame.film_point)
    for (int axis = 0; axis < 3; ++axis) {
      box[0][axis] = std::min(box[0][axis], x[axis]);
      box[1][axis] = std::max(box[1][axis], x[axis]);
    }
  return box;
}

Image render(const state::FilmFrame& frame, const RenderOptions& options) {
  if (options.width < 1 || options.height < 1 || options.samples < 1)
    throw InputError(
        fmt::format("a picture of {} x {} pixels cannot be drawn", options.width, options.height));
  Image image(options.width, options.height);
  const Painter painter(frame, options);
  paint_rows(painter, image);
  if (options.style == Style::Thickness) draw_colour_bar(image, painter.range());
  if (options.label_time) {
    const double letter = std::max(9.0, options.height / 55.0);
    draw_label(image, time_text(frame.time), 1.5 * letter, options.height - 1.8 * letter, letter,
               from_screen(50, 58, 70));
  }
  return image;
}

void render(const state::FilmFrame& frame, const RenderOptions& options, const std::filesystem::path& path) {
  write_png(render(frame, options), path);
}

}  // namespace spume::optics
