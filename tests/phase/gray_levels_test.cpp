// Brightness and noise of the frames of a Gray code.
#include <cmath>
#include <cstdint>
#include <utility>
#include <variant>

#include <gtest/gtest.h>

#include "frangia/core/random.h"
#include "frangia/pattern/gray_code.h"
#include "frangia/phase/gray/decode_gray_alone.h"

namespace frangia {
namespace {

/// Frames of a code whose dark and bright counts are 20 and 20 + `gain` times the reflectance,
/// which rises along x; the variance of a pixel is 1 + counts / 40.
FrameStack gray_frames(InvertedFrames inverted, bool noisy = true) {
  Pattern code{.name = "code", .kind = PatternKind::Gray};
  code.bits = 6;
  code.stripe_px = 4.0;
  code.inverted = inverted;
  FrameStack stack{code, {}, 1023};
  for (int frame = 0; frame < code.frame_count(); ++frame) {
    Image<std::uint16_t> image(200, 150);
    for (int y = 0; y < 150; ++y) {
      for (int x = 0; x < 200; ++x) {
        const bool bright = is_stripe_bright(code, frame, 1.2 * x);
        const double counts = bright ? 80.0 + 3.0 * x : 60.0;
        const auto stream =
            hash(static_cast<std::uint64_t>(frame), static_cast<std::uint64_t>(200 * y + x));
        const double noise = noisy ? std::sqrt(1.0 + counts / 40.0) * normal_from(stream) : 0.0;
        image(x, y) = static_cast<std::uint16_t>(std::lround(counts + noise));
      }
    }
    stack.frames.emplace_back(std::move(image));
  }
  return stack;
}

TEST(EstimateGrayNoise, FindsShotAndReadNoiseFromPairsOfFrames) {
  // The sum of a frame and its inverse is that of white and black: the variance is that of both
  // counts, so that the line holds at their mean.
  const NoiseModel noise = estimate_gray_noise(gray_frames(InvertedFrames::After));
  for (const double counts : {80.0, 150.0, 300.0})
    EXPECT_NEAR(noise.variance(counts) / (1.0 + counts / 40.0), 1.0, 0.1) << counts;
}

TEST(EstimateGrayNoise, FindsShotAndReadNoiseFromNeighborsInTheRows) {
  const NoiseModel noise = estimate_gray_noise(gray_frames(InvertedFrames::None));
  for (const double counts : {100.0, 300.0, 500.0})
    EXPECT_NEAR(noise.variance(counts) / (1.0 + counts / 40.0), 1.0, 0.25) << counts;
}

TEST(EstimateGrayNoise, IsQuantizationNoiseOfExactFramesOrFewPixels) {
  const NoiseModel exact = estimate_gray_noise(gray_frames(InvertedFrames::After, false));
  EXPECT_LT(exact.variance(200.0), 0.3);
  EXPECT_GE(exact.floor_counts2, 1.0 / 12.0);
  FrameStack few = gray_frames(InvertedFrames::After);
  for (Frame& frame : few.frames) {
    const auto& image = std::get<Image<std::uint16_t>>(frame);
    Image<std::uint16_t> part(12, 11);  // 132 pixels with three samples each
    for (int y = 0; y < 11; ++y) {
      for (int x = 0; x < 12; ++x)
        part(x, y) = image(x + 100, y);
    }
    frame = std::move(part);
  }
  EXPECT_EQ(estimate_gray_noise(few).floor_counts2, NoiseModel{}.floor_counts2);
  EXPECT_EQ(estimate_gray_noise(few).slope_counts, 0.0);
}

FrameStack one_frame(std::uint16_t counts) {
  return {.pattern = {.name = "level"},
          .frames = {Frame(Image<std::uint16_t>(40, 30, counts))},
          .white_level = 1023};
}

/// A dark frame and one whose counts rise along x.
FrameStack dark_and_bright() {
  FrameStack stack{.pattern = {.name = "code"}, .frames = {}, .white_level = 1023};
  stack.frames.emplace_back(Image<std::uint16_t>(40, 30, 20));
  Image<std::uint16_t> bright(40, 30);
  for (int y = 0; y < 30; ++y) {
    for (int x = 0; x < 40; ++x)
      bright(x, y) = static_cast<std::uint16_t>(400 + 2 * x);
  }
  stack.frames.emplace_back(std::move(bright));
  return stack;
}

TEST(GrayThreshold, IsHalfwayBetweenWhiteAndAmbientWhereBothAreGiven) {
  const FrameStack gray = dark_and_bright();
  const FrameStack white = one_frame(301);
  const FrameStack ambient = one_frame(20);
  const Image<float> given = gray_threshold(gray, &white, &ambient);
  const Image<float> without_white = gray_threshold(gray, nullptr, &ambient);
  const Image<float> without_ambient = gray_threshold(gray, &white, nullptr);
  for (int x = 0; x < 40; ++x) {
    EXPECT_EQ(given(x, 7), 160.5F);
    const float own = 0.5F * (20.0F + 400.0F + 2.0F * static_cast<float>(x));
    EXPECT_EQ(without_white(x, 7), own) << "of the code itself";
    EXPECT_EQ(without_ambient(x, 7), own);
  }
}

TEST(GrayThreshold, IsMissingWhereTheContrastIsBelowThatOfTheNeighbors) {
  FrameStack gray = dark_and_bright();
  auto& bright = std::get<Image<std::uint16_t>>(gray.frames[1]);
  const auto scale = [&](int x, int y, double share) {
    bright(x, y) = static_cast<std::uint16_t>(std::lround(20.0 + share * (bright(x, y) - 20.0)));
  };
  scale(20, 10, 0.65);
  scale(30, 20, 0.75);
  scale(0, 0, 0.6);
  scale(39, 29, 0.6);
  const Image<float> threshold = gray_threshold(gray, nullptr, nullptr);
  int missing = 0;
  for (const float value : threshold.pixels())
    missing += std::isnan(value) ? 1 : 0;
  EXPECT_EQ(missing, 3);
  EXPECT_TRUE(std::isnan(threshold(20, 10)));
  EXPECT_TRUE(std::isnan(threshold(0, 0)));
  EXPECT_TRUE(std::isnan(threshold(39, 29)));
}

}  // namespace
}  // namespace frangia
