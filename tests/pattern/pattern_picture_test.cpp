#include "frangia/pattern/pattern_picture.h"

#include <cmath>

#include <gtest/gtest.h>

#include "frangia/core/angles.h"
#include "frangia/core/error.h"
#include "frangia/pattern/gray_code.h"

namespace frangia {
namespace {

TEST(PatternPicture, FringePhaseRefersToTheCentreOfAColumn) {
  const Pattern pattern{.name = "f", .period_px = 16.0, .shifts_rad = {0.0, kTwoPi / 4.0}};
  for (int frame = 0; frame < 2; ++frame) {
    const Image<float> picture = pattern_picture(pattern, frame, 40, 3);
    for (int x = 0; x < 40; ++x) {
      const double phase = kTwoPi * x / 16.0 + pattern.shifts_rad[static_cast<std::size_t>(frame)];
      EXPECT_NEAR(picture(x, 2), 0.5 + 0.5 * std::cos(phase), 1e-6);
    }
  }
}

TEST(PatternPicture, DiamondPixelsShowTheFringeAtTheirPlaceOnTheChip) {
  // DLP LightCrafter 4500: odd rows lie half a pixel to the right, which is one height of a row.
  const Pattern pattern{.name = "f", .period_px = 24.0, .shifts_rad = {0.0}};
  const Image<float> picture = pattern_picture(pattern, 0, 912, 1140, PixelLayout::Diamond);
  for (int x = 0; x < 912; ++x) {
    EXPECT_NEAR(picture(x, 500), 0.5 + 0.5 * std::cos(kTwoPi * (2 * x) / 24.0), 1e-5);
    EXPECT_NEAR(picture(x, 501), 0.5 + 0.5 * std::cos(kTwoPi * (2 * x + 1) / 24.0), 1e-5);
  }
}

TEST(PatternPicture, HorizontalFringesVaryFromRowToRow) {
  const Pattern pattern{
      .name = "f", .direction = FringeDirection::Horizontal, .period_px = 8.0, .shifts_rad = {0.0}};
  const Image<float> picture = pattern_picture(pattern, 0, 5, 20);
  for (int y = 0; y < 20; ++y) {
    for (int x = 0; x < 5; ++x)
      EXPECT_FLOAT_EQ(picture(x, y), picture(0, y % 8));
  }
}

TEST(PatternPicture, GrayCodeIdentifiesEveryColumn) {
  Pattern gray{.name = "g", .kind = PatternKind::Gray, .bits = 5};
  std::vector<std::uint32_t> code(32, 0);
  for (int bit = 0; bit < 5; ++bit) {
    const Image<float> picture = pattern_picture(gray, bit, 32, 1);
    for (int x = 0; x < 32; ++x) {
      code[static_cast<std::size_t>(x)] =
          2 * code[static_cast<std::size_t>(x)] + (picture(x, 0) > 0.5F ? 1U : 0U);
    }
  }
  for (std::uint32_t x = 0; x < 32; ++x)
    EXPECT_EQ(gray_to_binary(code[x]), x);
}

TEST(PatternPicture, RefusesPatternsThatAProjectorCannotShow) {
  EXPECT_THROW(
      static_cast<void>(pattern_picture({.name = "l", .kind = PatternKind::Line}, 0, 8, 8)), Error);
  EXPECT_THROW(static_cast<void>(pattern_picture({.name = "f", .shifts_rad = {0.0}}, 0, 8, 8)),
               Error);
}

}  // namespace
}  // namespace frangia
