#include "spume/optics/render.hpp"

#include <gtest/gtest.h>
#include <png.h>

#include <cmath>

#include "spume/base/error.hpp"
#include "spume/mesh/topology.hpp"
#include "tests/support/film_shapes.hpp"
#include "tests/support/scratch_folder.hpp"

namespace spume::optics {
namespace {

/// A double bubble of the given radius whose films all have the half-thickness `eta`.
state::FilmFrame double_bubble(double radius, double eta) {
  const auto films = shapes::double_bubble(radius, 8);
  const auto topology = mesh::build_topology(films);
  state::FilmFrame frame;
  for (const auto& dof : topology.film_dof) frame.film_point.push_back(films.position[dof.vertex]);
  frame.half_thickness.assign(frame.film_point.size(), eta);
  for (int t = 0; t < films.n_triangles(); ++t)
    frame.triangle.push_back({topology.corner_dof[t], topology.triangle_lamella[t], films.triangle[t].phase_a,
                              films.triangle[t].phase_b});
  frame.border_line.emplace_back();
  for (int v : topology.border[0].vertices) {
    frame.border_line[0].push_back(static_cast<int>(frame.border_point.size()));
    frame.border_point.push_back(films.position[v]);
  }
  frame.border_area.assign(frame.border_point.size(), 0.003 * radius * radius);
  return frame;
}

RenderOptions small() {
  RenderOptions options;
  options.width = 120;
  options.height = 90;
  options.samples = 2;
  return options;
}

double brightness(const Colour& c) {
  return (c.r + c.g + c.b) / 3;
}

double largest_difference(const Image& a, const Image& b) {
  double largest = 0;
  for (int y = 0; y < a.height(); ++y)
    for (int x = 0; x < a.width(); ++x) {
      const Colour &p = a(x, y), &q = b(x, y);
      largest = std::max({largest, std::abs(p.r - q.r), std::abs(p.g - q.g), std::abs(p.b - q.b)});
    }
  return largest;
}

/// Pixels that differ from the picture of no films.
int n_drawn(const Image& image, RenderOptions options) {
  const Image empty = render(state::FilmFrame{}, options);
  int n = 0;
  for (int y = 0; y < image.height(); ++y)
    for (int x = 0; x < image.width(); ++x) {
      const Colour &p = image(x, y), &q = empty(x, y);
      n += p.r != q.r || p.g != q.g || p.b != q.b;
    }
  return n;
}

TEST(Render, FoamFillsThePictureUpToTheMargin) {
  const RenderOptions options = small();
  const Image image = render(double_bubble(1e-3, 1e-6), options);
  // The two balls seen nearly from the side cover about half of the picture.
  const double share = n_drawn(image, options) / (120.0 * 90.0);
  EXPECT_GT(share, 0.35);
  EXPECT_LT(share, 0.75);
}

TEST(Render, PictureDoesNotDependOnTheUnitOfLength) {
  RenderOptions options = small();
  options.label_time = false;
  const Image small_foam = render(double_bubble(1e-3, 1e-6), options),
              large = render(double_bubble(1, 1e-6), options);
  // Rays at the edge of a triangle may fall on either side by round-off.
  int n_different = 0;
  for (int y = 0; y < 90; ++y)
    for (int x = 0; x < 120; ++x) n_different += std::abs(small_foam(x, y).g - large(x, y).g) > 0.02;
  EXPECT_LE(n_different, 20);
}

TEST(Render, PictureIsTheSameEachTime) {
  const auto frame = double_bubble(1e-3, 1e-6);
  EXPECT_EQ(largest_difference(render(frame, small()), render(frame, small())), 0);
}

TEST(Render, BordersAreDarkAndThickerWhereTheyHoldMoreLiquid) {
  const auto n_dark = [](double area) {
    auto frame = double_bubble(1e-3, 1e-6);
    for (double& a : frame.border_area) a = area;
    RenderOptions options = small();
    options.label_time = false;
    const Image image = render(frame, options);
    int n = 0;
    for (int y = 0; y < image.height(); ++y)
      for (int x = 0; x < image.width(); ++x) n += brightness(image(x, y)) < 0.25;
    return n;
  };
  EXPECT_GT(n_dark(1e-8), 30);
  EXPECT_GT(n_dark(4e-8), 1.5 * n_dark(1e-8));
}

TEST(Render, ThickFilmsAreYellowAndThinOnesBlue) {
  RenderOptions options = small();
  options.style = Style::Thickness;
  options.range = ThicknessRange{1e-7, 1e-5};
  const auto middle = [&](double eta) { return render(double_bubble(1e-3, eta), options)(45, 45); };
  const Colour thin = middle(1e-7), thick = middle(1e-5);
  EXPECT_GT(thin.b, thin.g);
  EXPECT_GT(thick.r, 2 * thick.b);
  // Beyond the range the colours end.
  EXPECT_EQ(middle(1e-9).b, thin.b);
  EXPECT_EQ(middle(1e-3).b, thick.b);
}

TEST(Render, ThicknessRangeLeavesOutTheRareExtremes) {
  state::FilmFrame frame;
  for (int n = 0; n < 1000; ++n) frame.half_thickness.push_back(1e-6 * (1 + 9 * n / 999.0));
  frame.half_thickness.push_back(1e-12);
  frame.half_thickness.push_back(1);
  frame.half_thickness.push_back(std::nan(""));
  const auto range = thickness_range(frame);
  EXPECT_NEAR(range.smallest, 1e-6, 0.1e-6);
  EXPECT_NEAR(range.largest, 10e-6, 0.1e-6);

  frame.half_thickness.assign(10, 2e-6);
  const auto even = thickness_range(frame);
  EXPECT_NEAR(even.largest / even.smallest, 1.5, 1e-12);
  EXPECT_LT(even.smallest, 2e-6);
  EXPECT_GT(even.largest, 2e-6);
}

TEST(Render, WritesThePictureAsPng) {
  const testing::ScratchFolder folder;
  const auto path = folder.path() / "foam.png";
  const auto frame = double_bubble(1e-3, 1e-6);
  render(frame, small(), path);
  png_image header{};
  header.version = PNG_IMAGE_VERSION;
  ASSERT_NE(png_image_begin_read_from_file(&header, path.c_str()), 0);
  EXPECT_EQ(header.width, 120u);
  EXPECT_EQ(header.height, 90u);
  header.format = PNG_FORMAT_RGB;
  std::vector<png_byte> bytes(PNG_IMAGE_SIZE(header));
  ASSERT_NE(png_image_finish_read(&header, nullptr, bytes.data(), 0, nullptr), 0);
  const Image image = render(frame, small());
  EXPECT_EQ(bytes[3 * (45 * 120 + 60) + 1], to_screen(image(60, 45).g));
  EXPECT_THROW(render(frame, small(), "/nowhere/foam.png"), std::runtime_error);
}

TEST(Render, RefusesAPictureWithoutPixels) {
  RenderOptions options;
  options.width = 0;
  EXPECT_THROW(render(state::FilmFrame{}, options), InputError);
}

}  // namespace
}  // namespace spume::optics
