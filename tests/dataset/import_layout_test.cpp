#include "frangia/dataset/import_layout.h"

#include <cmath>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "frangia/core/angles.h"
#include "frangia/pattern/gray_code.h"

#include "support/error_of.h"

namespace frangia {
namespace {

using testing::error_of;

ImportLayout layout_of(const char* name, std::size_t images, ProjectorSize size) {
  return make_layout(*find_layout(name), images, size);
}

/// The light of an image of a Gray code along the projector's columns or rows, as digits.
std::string stripes(const ImportLayout& layout, std::size_t image, int side) {
  const auto& [pattern, frame] = layout.images[image].value();
  std::string text;
  for (int column = 0; column < side; ++column)
    text += is_stripe_bright(layout.patterns[pattern], static_cast<int>(frame), column) ? '1' : '0';
  return text;
}

/// Printed by OpenCV 4.6: cv2.structured_light_GrayCodePattern.create(24, 10).generate(), the first
/// row of the first ten images and the first column of the others.
const std::vector<std::string> kOpenCvImages = {"000000000000000011111111",
                                                "111111111111111100000000",
                                                "000000001111111111111111",
                                                "111111110000000000000000",
                                                "000011111111000000001111",
                                                "111100000000111111110000",
                                                "001111000011110000111100",
                                                "110000111100001111000011",
                                                "011001100110011001100110",
                                                "100110011001100110011001",
                                                "0000000011",
                                                "1111111100",
                                                "0000111111",
                                                "1111000000",
                                                "0011110000",
                                                "1100001111",
                                                "0110011001",
                                                "1001100110"};

TEST(ImportLayout, ShowsTheStripesThatOpenCvGenerates) {
  const ImportLayout layout = layout_of("opencv-gray-code", 20, {24, 10});
  ASSERT_EQ(layout.images.size(), 20U);
  for (std::size_t i = 0; i < kOpenCvImages.size(); ++i)
    EXPECT_EQ(stripes(layout, i, i < 10 ? 24 : 10), kOpenCvImages[i]) << i;
  EXPECT_EQ(layout.patterns[layout.images[18]->first].kind, PatternKind::White);
  EXPECT_EQ(layout.patterns[layout.images[19]->first].kind, PatternKind::Ambient);
  EXPECT_EQ(layout_of("opencv-gray-code", 18, {24, 10}).images.size(), 18U);
}

TEST(ImportLayout, ShowsTheSameStripesFor3dunderworldAfterWhiteAndBlack) {
  const ImportLayout layout = layout_of("3dunderworld", 20, {24, 10});
  EXPECT_EQ(layout.patterns[layout.images[0]->first].kind, PatternKind::White);
  EXPECT_EQ(layout.patterns[layout.images[1]->first].kind, PatternKind::Ambient);
  for (std::size_t i = 0; i < kOpenCvImages.size(); ++i)
    EXPECT_EQ(stripes(layout, i + 2, i < 10 ? 24 : 10), kOpenCvImages[i]) << i;
}

/// ProjectorWidget::make_pattern of scan3d-capture: whether image `image` is white at column or row
/// `at`, with `count` patterns per direction.
bool scan3d_is_white(int image, int at, int count, int columns, int rows) {
  const auto bits_of = [](int side) {
    int bits = 1;
    while ((1 << bits) < side)
      ++bits;
    return bits;
  };
  const int vertical_bits = bits_of(columns);
  const int horizontal_bits = bits_of(rows);
  const bool is_inverted = image % 2 == 0;
  const bool is_vertical = image < 2 * count + 2;
  const int bit = is_vertical ? vertical_bits - image / 2 : horizontal_bits + count - image / 2;
  const int offset =
      is_vertical ? ((1 << vertical_bits) - columns) / 2 : ((1 << horizontal_bits) - rows) / 2;
  const int number = at + offset;
  const bool test = (((number >> 1) ^ number) & (1 << bit)) != 0;
  return test != !is_inverted;  // patterns are made with `!inverted`
}

TEST(ImportLayout, ShowsTheStripesOfScan3dCapture) {
  for (const int count : {4, 5}) {  // all bits of the rows; one bit of the columns is left out
    const ProjectorSize size = {40, 24};
    const auto images = static_cast<std::size_t>(2 + 4 * count);
    const ImportLayout layout = layout_of("scan3d-capture", images, size);
    for (int image = 2; image < 2 + 4 * count; ++image) {
      const int side = image < 2 * count + 2 ? size[0] : size[1];
      std::string expected;
      for (int at = 0; at < side; ++at)
        expected += scan3d_is_white(image, at, count, size[0], size[1]) ? '1' : '0';
      EXPECT_EQ(stripes(layout, static_cast<std::size_t>(image), side), expected)
          << count << ' ' << image;
    }
  }
}

TEST(ImportLayout, ShowsTheFringesOfSlStudio) {
  const ImportLayout layout = layout_of("slstudio-phase-shift-2x3", 12, {912, 1140});
  const double pi = 3.14159265358979;
  for (std::size_t i = 0; i < 12; ++i) {
    const auto& [pattern, frame] = layout.images[i].value();
    const Pattern& fringes = layout.patterns[pattern];
    const double side = i < 6 ? 912.0 : 1140.0;
    const double pitch = (i / 3) % 2 == 0 ? side / 16.0 : side;  // computePhaseVector
    EXPECT_EQ(fringes.direction, i < 6 ? FringeDirection::Vertical : FringeDirection::Horizontal);
    for (const double at : {0.0, 10.0, 333.0}) {
      EXPECT_NEAR(std::cos(kTwoPi * at / fringes.period_px + fringes.shifts_rad[frame]),
                  std::cos(2.0 * pi * at / pitch - 2.0 * pi / 3.0 * static_cast<double>(i % 3)),
                  1e-9);
    }
  }
  // The ten widest of eleven bits over 1280 columns.
  const ImportLayout gray = layout_of("slstudio-gray-code", 12, {1280, 800});
  EXPECT_EQ(gray.patterns[1].stripe_px, 2.0);
  EXPECT_EQ(layout_of("slstudio-gray-code", 18, {1280, 800}).patterns.size(), 4U);
}

TEST(ImportLayout, RefusesAnotherNumberOfImages) {
  const std::string error = error_of([] {
    static_cast<void>(layout_of("opencv-gray-code", 17, {24, 10}));
  });
  EXPECT_EQ(error,
            "the layout opencv-gray-code has 18 images for a projector of 24 x 10 pixels, but the "
            "folder has 17; correct `projector` or choose another `layout`");
}

}  // namespace
}  // namespace frangia
