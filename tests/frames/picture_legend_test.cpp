#include "frangia/frames/picture_legend.h"

#include <algorithm>
#include <set>

#include <gtest/gtest.h>

#include "frangia/frames/internal/draw_text.h"

namespace frangia {
namespace {

std::vector<std::string> texts(ValueRange range, bool whole_numbers = false) {
  std::vector<std::string> found;
  for (const ScaleTick& tick : scale_ticks({.range = range, .whole_numbers = whole_numbers}))
    found.push_back(tick.text);
  return found;
}
using Texts = std::vector<std::string>;

TEST(ScaleTicks, AreRoundNumbersWithEqualDecimals) {
  EXPECT_EQ(texts({0.0F, 0.1F}), (Texts{"0.00", "0.02", "0.04", "0.06", "0.08", "0.10"}));
  EXPECT_EQ(texts({417.3F, 632.9F}), (Texts{"450", "500", "550", "600"}));
  EXPECT_EQ(texts({0.0F, 0.0015F}), (Texts{"0.0000", "0.0005", "0.0010", "0.0015"}));
}

TEST(ScaleTicks, HaveSignsWhenAnyIsNegativeButZeroHasNone) {
  EXPECT_EQ(texts({-0.1F, 0.1F}), (Texts{"-0.10", "-0.05", "0.00", "+0.05", "+0.10"}));
}

TEST(ScaleTicks, OfCountsAreWhole) {
  EXPECT_EQ(texts({0.0F, 3.0F}, true), (Texts{"0", "1", "2", "3"}));
  EXPECT_EQ(texts({5.0F, 5.0F}, true), (Texts{"5"}));
}

/// The pixels that a text colors, as a string.
std::string ink_of(const std::string& text) {
  Image<Rgb> picture(40, 40, Rgb{255, 255, 255});
  draw_text(picture, text, {8.0, 28.0, 20.0}, {0, 0, 0});
  std::string ink;
  for (const Rgb& pixel : picture.pixels())
    ink += static_cast<char>(pixel[0]);
  return ink;
}

TEST(DrawText, DrawsEveryLetterAndDigitDifferently) {
  const std::string letters =
      "0123456789ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz+-.,:;()[]/%=<>!?_'\"*#&^| ";
  std::set<std::string> shapes{ink_of("\x01")};  // a character without a glyph
  for (const char letter : letters)
    EXPECT_TRUE(shapes.insert(ink_of(std::string(1, letter))).second) << letter;
}

TEST(DrawText, GivesNumbersOfEqualLengthEqualWidth) {
  EXPECT_EQ(text_width("+0.10", 12.0), text_width("-0.88", 12.0));
  EXPECT_EQ(text_width("1111", 12.0), text_width("0000", 12.0));
}

TEST(DrawText, IsClippedAtTheEdgesOfThePicture) {
  Image<Rgb> picture(10, 10, Rgb{255, 255, 255});
  draw_text(picture, "clipped", {-20.0, 5.0, 30.0}, {0, 0, 0});
  draw_text(picture, "clipped", {50.0, -50.0, 30.0}, {0, 0, 0});
  EXPECT_EQ(picture.width(), 10);
}

TEST(AddLegend, DrawsTheWholeMapWithItsHighEndOnTop) {
  const Image<Rgb> picture(300, 400, Rgb{10, 20, 30});
  const PictureLegend legend{.scales = {{ColorMap::Viridis, {0.0F, 1.0F}, "sigma, mm"}},
                             .entries = {{{200, 10, 100}, "inside"}}};
  const Image<Rgb> out = add_legend(picture, legend);
  ASSERT_EQ(out.height(), 400);
  ASSERT_GT(out.width(), 360);
  EXPECT_EQ(out(299, 399), (Rgb{10, 20, 30}));
  // Along the middle of the bar, the colors run from the end of the map to its beginning.
  const int x = 300 + 8 + 8 * 2;
  std::vector<int> rows;
  for (const float value : {1.0F, 0.5F, 0.0F}) {
    const Rgb wanted = pixel_of(ColorMap::Viridis, value);
    for (int y = 0; y < 400; ++y) {
      const Rgb& found = out(x, y);
      const bool same = std::equal(found.begin(), found.end(), wanted.begin(), [](int a, int b) {
        return std::abs(a - b) <= 2;
      });
      if (same) {
        rows.push_back(y);
        break;
      }
    }
  }
  ASSERT_EQ(rows.size(), 3U);
  EXPECT_LT(rows[0], rows[1]);
  EXPECT_LT(rows[1], rows[2]);
  EXPECT_EQ(std::count(out.pixels().begin(), out.pixels().end(), Rgb{200, 10, 100}) > 50, true);
}

TEST(AddLegend, LeavesAPictureWithoutOneAsItIs) {
  const Image<Rgb> picture(30, 40, Rgb{10, 20, 30});
  EXPECT_EQ(add_legend(picture, {}).width(), 30);
}

}  // namespace
}  // namespace frangia
