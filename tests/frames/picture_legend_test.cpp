#include "frangia/frames/picture_legend.h"

#include <algorithm>
#include <set>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "frangia/core/image.h"
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

constexpr Rgb kGround{9, 9, 9};
constexpr Rgb kPaperColor{244, 245, 247};
constexpr Rgb kInkColor{42, 47, 56};
constexpr Rgb kBarColor{126, 134, 148};  // of a histogram
constexpr Rgb kMarkColor{176, 24, 24};   // of a limit

/// The smallest box that holds the pixels of a color, right and bottom exclusive.
PixelBox box_of(const Image<Rgb>& picture, const Rgb& color, const PixelBox& within) {
  PixelBox box{within.right, within.bottom, within.left, within.top};
  for (int y = within.top; y < within.bottom; ++y) {
    for (int x = within.left; x < within.right; ++x) {
      if (picture(x, y) != color) continue;
      box = {std::min(box.left, x),
             std::min(box.top, y),
             std::max(box.right, x + 1),
             std::max(box.bottom, y + 1)};
    }
  }
  return box;
}

/// A legend beside a picture of 40 x 1000 pixels, whose capitals are 20 pixels high.
struct DrawnLegend {
  explicit DrawnLegend(const PictureLegend& legend)
      : out(add_legend(Image<Rgb>(40, 1000, kGround), legend)) {
    all = {40, 0, out.width(), 1000};
  }
  /// The bar of the only scale, which runs through the grays: within its frame of 2 pixels.
  [[nodiscard]] PixelBox bar() const {
    const int x = 40 + 32 + 5;
    int top = 0;
    while (out(x, top) != Rgb{255, 255, 255})
      ++top;
    int bottom = 999;
    while (out(x, bottom) != Rgb{0, 0, 0})
      --bottom;
    int right = x;
    while (out(right, top) == Rgb{255, 255, 255})
      ++right;
    int left = x;
    while (out(left - 1, top) == Rgb{255, 255, 255})
      --left;
    return {left, top, right, bottom + 1};
  }
  Image<Rgb> out;
  PixelBox all;
};

PictureLegend one_scale(ValueRange range = {0.0F, 1.0F}) {
  return {.scales = {{.map = ColorMap::Gray, .range = range, .label = "mm"}}, .entries = {}};
}

TEST(AddLegend, DrawsABarWhoseRowsHaveTheColorsOfTheirValues) {
  const DrawnLegend drawn(one_scale());
  const PixelBox bar = drawn.bar();
  EXPECT_EQ(bar.left, 40 + 32);         // a margin of 1.6 capitals
  EXPECT_EQ(bar.right - bar.left, 34);  // 1.7 capitals
  EXPECT_EQ(bar.top, 32 + 52);          // below the label and the gap
  EXPECT_EQ(bar.bottom, 1000 - 32 - 32 - 10);
  for (int y = bar.top; y < bar.bottom; ++y) {
    const double share = (bar.bottom - (y + 0.5)) / (bar.bottom - bar.top);
    for (const int x : {bar.left, bar.right - 1})
      EXPECT_NEAR(drawn.out(x, y)[0], 255.0 * share, 1.0);
  }
  for (const int beyond : {bar.left - 1, bar.left - 2, bar.right, bar.right + 1})
    EXPECT_EQ(drawn.out(beyond, bar.top + 7), kInkColor);
  EXPECT_EQ(drawn.out(bar.left - 3, bar.top + 7), kPaperColor);
  EXPECT_EQ(drawn.out(bar.right + 2, bar.top + 7), kPaperColor);
  EXPECT_EQ(drawn.out(bar.left, bar.top - 2), kInkColor);
  EXPECT_EQ(drawn.out(bar.left, bar.top - 3), kPaperColor);
  EXPECT_EQ(drawn.out(bar.left, bar.bottom + 1), kInkColor);
  EXPECT_EQ(drawn.out(bar.left, bar.bottom + 2), kPaperColor);
}

TEST(AddLegend, DrawsATickAtEachRoundValue) {
  const PictureLegend legend = one_scale({-3.0F, 9.0F});
  const DrawnLegend drawn(legend);
  const PixelBox bar = drawn.bar();
  std::vector<double> rows;  // of ticks, from the top
  for (int y = bar.top - 3; y < bar.bottom + 3; ++y)
    if (drawn.out(bar.right + 8, y) == kInkColor && drawn.out(bar.right + 8, y - 1) != kInkColor)
      rows.push_back(y + 1.0);
  std::vector<double> wanted;
  for (const double value : {8.0, 6.0, 4.0, 2.0, 0.0, -2.0})
    wanted.push_back(bar.bottom - (value + 3.0) / 12.0 * (bar.bottom - bar.top));
  ASSERT_EQ(rows.size(), wanted.size());
  for (std::size_t i = 0; i < rows.size(); ++i)
    EXPECT_NEAR(rows[i], wanted[i], 1.0);
  EXPECT_EQ(drawn.out(bar.right + 9, static_cast<int>(rows[0])), kPaperColor)
      << "0.45 capitals long";
  // The numbers end in one column, within the legend's margin.
  const PixelBox numbers =
      box_of(drawn.out, kInkColor, {bar.right + 12, bar.top - 12, drawn.out.width(), 1000});
  const double wide = text_width("+8", 20.0);
  EXPECT_NEAR(numbers.right, bar.right + 20.0 * (0.45 + 0.7) + wide, 2.0);
  EXPECT_NEAR(numbers.left, numbers.right - wide, 3.0);
  EXPECT_NEAR(drawn.out.width(), bar.right + 20.0 * (0.45 + 0.7) + wide + 32.0, 2.0);
}

TEST(AddLegend, DrawsAHistogramWithItsLongestBarAtFullWidth) {
  PictureLegend legend = one_scale();
  legend.scales[0].histogram = {0.1F, 0.4F, 0.2F, 0.0F};
  const DrawnLegend drawn(legend);
  const PixelBox bar = drawn.bar();
  const int height = bar.bottom - bar.top;
  const double length[] = {25.0, 100.0, 50.0, 0.0};  // five capitals
  int left = 0;
  for (int i = 0; i < 4; ++i) {
    const int y = bar.bottom - height * (2 * i + 1) / 8;
    const PixelBox row = box_of(drawn.out, kBarColor, {bar.right, y, drawn.out.width(), y + 1});
    EXPECT_NEAR(std::max(0, row.right - row.left), length[i], 1.0) << i;
    if (i == 0) left = row.left;
    if (i < 3) {
      EXPECT_EQ(row.left, left);
    }
    EXPECT_EQ(drawn.out(left - 1, y), kInkColor) << "the axis of the histogram";
  }
  const PixelBox whole = box_of(drawn.out, kBarColor, drawn.all);
  EXPECT_NEAR(whole.bottom, bar.bottom, 1.0);
  EXPECT_NEAR(whole.top, bar.bottom - 0.75 * height, 1.0);
  EXPECT_NEAR(drawn.out.width(), whole.right + 32, 2.0);
}

TEST(AddLegend, MarksLimitsWithinTheRangeAcrossTheBar) {
  PictureLegend legend = one_scale({-1.0F, 1.0F});
  legend.scales[0].limits = {0.5, -0.25, 7.0};
  const DrawnLegend drawn(legend);
  const PixelBox bar = drawn.bar();
  std::vector<double> rows;
  for (int y = 0; y < 1000; ++y)
    if (drawn.out(bar.left + 3, y) == kMarkColor && drawn.out(bar.left + 3, y - 1) != kMarkColor)
      rows.push_back(y + 1.0);
  ASSERT_EQ(rows.size(), 2U);
  EXPECT_NEAR(rows[0], bar.bottom - 0.75 * (bar.bottom - bar.top), 1.0);
  EXPECT_NEAR(rows[1], bar.bottom - 0.375 * (bar.bottom - bar.top), 1.0);
  const auto y = static_cast<int>(rows[0]);
  EXPECT_EQ(drawn.out(bar.right - 1, y), kMarkColor);
  const PixelBox number =
      box_of(drawn.out, kMarkColor, {bar.right + 1, y - 12, drawn.out.width(), y + 12});
  EXPECT_NEAR(number.bottom - number.top, 20.0, 3.0);
  EXPECT_NEAR(0.5 * (number.top + number.bottom), rows[0], 2.0);
  EXPECT_LE(number.right, drawn.out.width() - 30);
}

TEST(AddLegend, DrawsItsEntriesBelowEachOtherUnderTheScales) {
  PictureLegend legend{.scales = {}, .entries = {{{1, 2, 3}, "one"}, {{4, 5, 6}, "another"}}};
  const DrawnLegend alone(legend);
  const PixelBox one = box_of(alone.out, {1, 2, 3}, alone.all);
  const PixelBox other = box_of(alone.out, {4, 5, 6}, alone.all);
  EXPECT_EQ(one.left, 72);
  EXPECT_EQ(one.top, 32);
  EXPECT_EQ(one.width(), 34);
  EXPECT_EQ(one.height(), 20);
  EXPECT_EQ(other.top, 32 + 42);
  EXPECT_NEAR(alone.out.width(), 72 + 20.0 * (1.7 + 0.7) + text_width("another", 20.0) + 32, 2.0);
  legend.scales = one_scale().scales;
  legend.scales.push_back(legend.scales[0]);
  const DrawnLegend below(legend);
  EXPECT_EQ(box_of(below.out, {4, 5, 6}, below.all).bottom, 1000 - 32 - 42 + 20);
  // Two scales share the height above the entries.
  const int height = (1000 - 2 * 32 - 2 * 42) / 2;
  EXPECT_EQ(below.out(75, 32 + 52), (Rgb{255, 255, 255}));
  EXPECT_EQ(below.out(75, 32 + height + 52), (Rgb{255, 255, 255}));
  EXPECT_EQ(below.out(75, 32 + height - 32 - 10 - 1), (Rgb{0, 0, 0}));
}

TEST(ScaleTicks, TakeStepsOfOneTwoOrFiveInAtMostSixSteps) {
  const auto step = [](double high) {
    const auto ticks = scale_ticks({.range = {0.0F, static_cast<float>(high)}, .label = {}});
    return ticks[1].value - ticks[0].value;
  };
  EXPECT_NEAR(step(6.0), 1.0, 1e-9);
  EXPECT_NEAR(step(6.1), 2.0, 1e-9);
  EXPECT_NEAR(step(12.1), 5.0, 1e-9);
  EXPECT_NEAR(step(30.1), 10.0, 1e-9);
  EXPECT_NEAR(step(0.0059), 0.001, 1e-9);
  EXPECT_EQ(scale_ticks({.range = {0.0F, 2.0F}, .label = {}, .whole_numbers = true}).size(), 3U);
  EXPECT_EQ(texts({0.0F, 6e8F})[1], "1e+08");
  EXPECT_EQ(texts({0.0F, 3e-8F})[1], "5e-09");
  EXPECT_EQ(texts({2.5F, 2.5F}), Texts{"2.500"});
}

TEST(AddLegend, LeavesAPictureWithoutOneAsItIs) {
  const Image<Rgb> picture(30, 40, Rgb{10, 20, 30});
  EXPECT_EQ(add_legend(picture, {}).width(), 30);
}

}  // namespace
}  // namespace frangia
