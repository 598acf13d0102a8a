#include <gtest/gtest.h>

#include <cmath>

#include "spume/optics/colour.hpp"
#include "spume/optics/colour_bar.hpp"
#include "spume/optics/label.hpp"

namespace spume::optics {
namespace {

std::vector<std::string> texts_of(const std::vector<Tick>& ticks) {
  std::vector<std::string> texts;
  for (const auto& tick : ticks) texts.push_back(tick.text);
  return texts;
}

TEST(Colour, ScreenNumbersComeBack) {
  for (int n = 0; n < 256; ++n) EXPECT_EQ(to_screen(from_screen(n, 0, 0).r), n);
  EXPECT_EQ(to_screen(-1), 0);
  EXPECT_EQ(to_screen(7), 255);
}

TEST(Colour, ViridisGetsSteadilyBrighter) {
  const auto luminance = [](const Colour& c) { return 0.2126 * c.r + 0.7152 * c.g + 0.0722 * c.b; };
  for (int n = 0; n < 100; ++n) EXPECT_LT(luminance(viridis(n / 100.0)), luminance(viridis((n + 1) / 100.0)));
  EXPECT_EQ(viridis(-3).g, viridis(0).g);
  EXPECT_EQ(viridis(3).g, viridis(1).g);
}

TEST(Colour, BubblesOfNearNumbersDiffer) {
  for (int p = 1; p < 30; ++p)
    for (int q = p + 1; q < p + 5; ++q) {
      const Colour a = bubble_colour(p), b = bubble_colour(q);
      EXPECT_GT(std::hypot(a.r - b.r, a.g - b.g, a.b - b.b), 0.1) << p << " " << q;
      for (double light : {a.r, a.g, a.b}) EXPECT_TRUE(light >= 0 && light <= 1.0001);
    }
}

TEST(ColourBar, MarksAreRoundAndCarryUnits) {
  EXPECT_EQ(texts_of(log_ticks({1e-8, 1e-4})),
            (std::vector<std::string>{"10 nm", "100 nm", "1 µm", "10 µm", "100 µm"}));
  EXPECT_EQ(texts_of(log_ticks({3e-7, 6e-6})), (std::vector<std::string>{"500 nm", "1 µm", "2 µm", "5 µm"}));
  const auto narrow = log_ticks({4e-6, 6e-6});
  EXPECT_GE(narrow.size(), 3u);
  EXPECT_EQ(narrow.front().text, "4 µm");
}

TEST(ColourBar, EqualRatiosAreEqualDistances) {
  const ThicknessRange range{1e-8, 1e-4};
  EXPECT_NEAR(place_in(range, 1e-7), 0.25, 1e-12);
  EXPECT_NEAR(place_in(range, 1e-4), 1, 1e-12);
}

TEST(Label, DrawsWithinItsWidthAndHeight) {
  Image image(200, 40);
  const double height = 14, width = label_width("0.5 µm", height);
  draw_label(image, "0.5 µm", 20, 20, height, {1, 1, 1});
  int n = 0;
  for (int y = 0; y < 40; ++y)
    for (int x = 0; x < 200; ++x)
      if (image(x, y).r > 0) {
        ++n;
        EXPECT_TRUE(x >= 19 && x <= 20 + width + 1 && y >= 20 - 0.7 * height && y <= 20 + 0.9 * height)
            << x << " " << y;
      }
  EXPECT_GT(n, 100);
}

TEST(Label, EveryLetterThatTheProgramWritesLooksDifferent) {
  const std::vector<std::string> letters{"0", "1", "2", "3", "4", "5", "6", "7", "8", "9", "a", "c", "e", "f",
                                         "h", "i", "k", "l", "m", "n", "s", "t", "µ", "-", "+", ".", "="};
  std::vector<std::vector<double>> pictures;
  for (const auto& letter : letters) {
    Image image(24, 32);
    draw_label(image, letter, 4, 16, 14, {1, 1, 1});
    std::vector<double> picture;
    for (int y = 0; y < 32; ++y)
      for (int x = 0; x < 24; ++x) picture.push_back(image(x, y).r);
    for (const auto& other : pictures) EXPECT_NE(picture, other) << letter;
    pictures.push_back(picture);
  }
}

}  // namespace
}  // namespace spume::optics
