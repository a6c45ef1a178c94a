#include "frangia/frames/grey_image.h"

#include <cmath>
#include <string>
#include <utility>

#include <gtest/gtest.h>

#include "frangia/frames/jpeg_noise.h"

#include "support/error_of.h"

namespace frangia {
namespace {

using testing::error_of;

/// A colour image of 4 x 4 pixels of one colour.
RasterImage one_color(int red, int green, int blue) {
  Image<std::uint8_t> samples(12, 4);
  for (int y = 0; y < 4; ++y) {
    for (int x = 0; x < 4; ++x) {
      samples(3 * x, y) = static_cast<std::uint8_t>(red);
      samples(3 * x + 1, y) = static_cast<std::uint8_t>(green);
      samples(3 * x + 2, y) = static_cast<std::uint8_t>(blue);
    }
  }
  return {std::move(samples), 3};
}

TEST(GreyImage, TakesAChannelAsItIs) {
  const auto channel = [](const char* name) {
    const Samples grey = grey_image(one_color(200, 100, 50), parse_color_choice(name));
    return static_cast<int>(std::get<Image<std::uint8_t>>(grey)(3, 2));
  };
  EXPECT_EQ(channel("red"), 200);
  EXPECT_EQ(channel("green"), 100);
  EXPECT_EQ(channel("blue"), 50);
}

TEST(GreyImage, KeepsTheFractionsOfTheLuminanceIn16Bits) {
  const Samples grey = grey_image(one_color(200, 100, 51), {GreyFrom::Luminance});
  const double expected = 0.299 * 200 + 0.587 * 100 + 0.114 * 51;
  EXPECT_EQ(std::get<Image<std::uint16_t>>(grey)(0, 0), std::lround(257.0 * expected));
  const Samples white = grey_image(one_color(255, 255, 255), {GreyFrom::Luminance});
  EXPECT_EQ(std::get<Image<std::uint16_t>>(white)(0, 0), 65535);
}

TEST(GreyImage, RefusesColorWithoutAChoiceAndAcceptsEqualChannels) {
  const std::string error = error_of([] { static_cast<void>(grey_image(one_color(1, 2, 3), {})); });
  EXPECT_EQ(error, "is a colour image; set `color` to red, green, blue or luminance");
  const Samples grey = grey_image(one_color(77, 77, 77), {});
  EXPECT_EQ(std::get<Image<std::uint8_t>>(grey)(2, 2), 77);
  EXPECT_FALSE(error_of([] { static_cast<void>(parse_color_choice("pink")); }).empty());
}

/// A mosaic of a scene whose colours rise linearly over the image: bilinear interpolation is exact.
TEST(GreyImage, InterpolatesALinearSceneOfEachMosaicExactly) {
  const auto scene = [](char filter, int x, int y) {
    const double base = filter == 'R' ? 1000.0 : filter == 'G' ? 3000.0 : 2000.0;
    return base + 40.0 * x + 24.0 * y;
  };
  for (const std::string mosaic : {"RGGB", "BGGR", "GRBG", "GBRG"}) {
    Image<std::uint16_t> samples(10, 8);
    for (int y = 0; y < 8; ++y) {
      for (int x = 0; x < 10; ++x) {
        const char filter = mosaic[static_cast<std::size_t>(2 * (y % 2) + x % 2)];
        samples(x, y) = static_cast<std::uint16_t>(scene(filter, x, y));
      }
    }
    const ColorChoice choice = parse_color_choice("demosaic:" + mosaic);
    const RasterImage raw{std::move(samples), 1};
    const auto color = color_image(raw, choice);
    ASSERT_TRUE(color);
    EXPECT_EQ(std::get<Image<std::uint16_t>>(grey_image(raw, choice)).pixels()[13],
              std::get<Image<std::uint16_t>>(raw.samples).pixels()[13])
        << "a frame that carries a phase was interpolated";
    for (int y = 1; y < 7; ++y) {
      for (int x = 1; x < 9; ++x) {
        for (int c = 0; c < 3; ++c) {
          EXPECT_NEAR(std::get<Image<std::uint16_t>>(color->samples)(3 * x + c, y),
                      scene("RGB"[c], x, y),
                      0.51)
              << mosaic;
        }
      }
    }
  }
}

TEST(JpegNoise, GrowsAsTheQualityFalls) {
  // Means over parts and periods that tools/jpeg_noise.py measured, within a factor of two.
  EXPECT_NEAR(std::log2(jpeg_noise_counts2(90) / 1.1), 0.0, 1.0);
  EXPECT_NEAR(std::log2(jpeg_noise_counts2(75) / 4.6), 0.0, 1.0);
  EXPECT_NEAR(std::log2(jpeg_noise_counts2(50) / 11.5), 0.0, 1.0);
  EXPECT_LT(jpeg_noise_counts2(100), 0.1);
  for (int quality = 2; quality <= 100; ++quality)
    EXPECT_LT(jpeg_noise_counts2(quality), jpeg_noise_counts2(quality - 1)) << quality;
}

}  // namespace
}  // namespace frangia
