#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string>
#include <variant>
#include <vector>

#include <gtest/gtest.h>

#include "frangia/core/angles.h"
#include "frangia/phase/waveform/fringe_response.h"

#include "support/error_of.h"

namespace frangia {
namespace {

using testing::error_of;

double bent(double level) {
  return std::pow(level, 1.8);
}

/// A ramp on a part whose pixels reflect differently: counts are 10 plus `gain` times the light.
FrameStack ramp_frames(int illuminated, double gain = 200.0) {
  FrameStack stack{
      .pattern = {.name = "ramp", .kind = PatternKind::Ramp}, .frames = {}, .white_level = 255};
  for (int k = 0; k <= 8; ++k) {
    stack.pattern.levels.push_back(k / 8.0);
    Image<std::uint8_t> image(40, 10, 10);
    for (int i = 0; i < illuminated; ++i) {
      const double reflects = 0.5 + 0.5 * (i % 40) / 40.0;
      image(i % 40, i / 40) = static_cast<std::uint8_t>(
          std::lround(std::min(255.0, 10.0 + gain * reflects * bent(stack.pattern.levels.back()))));
    }
    stack.frames.emplace_back(std::move(image));
  }
  return stack;
}

TEST(MeasureResponse, IsTheMeanLightOfTheIlluminatedPixels) {
  const FrameStack ramp = ramp_frames(200);
  const ResponseCurve found = measure_response({&ramp, 1});
  for (int k = 0; k <= 8; ++k)
    EXPECT_NEAR(found.light_of(k / 8.0), bent(k / 8.0), 0.002) << k;
}

TEST(MeasureResponse, LeavesOutSaturatedAndDarkPixels) {
  // 4 of 10 columns exceed the white level; what is left has the same response.
  const FrameStack bright = ramp_frames(400, 300.0);
  EXPECT_NEAR(measure_response({&bright, 1}).light_of(0.5), bent(0.5), 0.002);
  // A contrast of 15 % of 255 counts is 38: pixels below add noise only.
  FrameStack ramp = ramp_frames(200);
  for (std::size_t k = 0; k < ramp.frames.size(); ++k) {
    auto& image = std::get<Image<std::uint8_t>>(ramp.frames[k]);
    for (int i = 200; i < 400; ++i)
      image(i % 40, i / 40) = static_cast<std::uint8_t>(k == 0 ? 10 : 47);  // not bent
  }
  EXPECT_NEAR(measure_response({&ramp, 1}).light_of(0.5), bent(0.5), 0.002);
  for (std::size_t k = 1; k < ramp.frames.size(); ++k) {
    auto& image = std::get<Image<std::uint8_t>>(ramp.frames[k]);
    for (int i = 200; i < 400; ++i)
      image(i % 40, i / 40) = 50;
  }
  EXPECT_GT(measure_response({&ramp, 1}).light_of(0.5), bent(0.5) + 0.05);
}

TEST(MeasureResponse, NeedsAHundredPixelsOfRampsOfTheSameLevels) {
  std::vector<FrameStack> ramps = {ramp_frames(60), ramp_frames(39)};
  EXPECT_NE(error_of([&] { static_cast<void>(measure_response(ramps)); }).find("too few"),
            std::string::npos);
  ramps[1] = ramp_frames(40);
  EXPECT_EQ(error_of([&] { static_cast<void>(measure_response(ramps)); }), "");
  ramps[1].pattern.levels[3] += 0.01;
  EXPECT_NE(error_of([&] { static_cast<void>(measure_response(ramps)); }).find("differ"),
            std::string::npos);
  ramps[1] = ramp_frames(40);
  ramps[1].frames.pop_back();
  EXPECT_NE(error_of([&] { static_cast<void>(measure_response(ramps)); }).find("differ"),
            std::string::npos);
  EXPECT_NE(error_of([&] { static_cast<void>(measure_response({})); }).find("ramp"),
            std::string::npos);
}

/// Fringes of a bent response in `frames` equal steps; a pixel's amplitude is `amplitude` counts.
FrameStack bent_fringes(int frames, double amplitude, double ambient = 12.0) {
  FrameStack stack{
      .pattern = {.name = "fringes", .period_px = 40.0}, .frames = {}, .white_level = 1023};
  for (int k = 0; k < frames; ++k) {
    const double shift = kTwoPi * k / frames;
    stack.pattern.shifts_rad.push_back(shift);
    Image<std::uint16_t> image(60, 20);
    for (int y = 0; y < 20; ++y) {
      for (int x = 0; x < 60; ++x) {
        const double level = 0.5 + 0.5 * std::cos(0.17 * x + 0.31 * y + shift);
        image(x, y) =
            static_cast<std::uint16_t>(std::lround(ambient + 2.0 * amplitude * bent(level)));
      }
    }
    stack.frames.emplace_back(std::move(image));
  }
  return stack;
}

TEST(MeasureFringeResponse, IsTheLightAtTheLevelsThatThePhaseTells) {
  const FrameStack fringes = bent_fringes(12, 300.0);
  const ResponseCurve found = measure_fringe_response({&fringes, 1});
  for (const double level : {0.1, 0.25, 0.5, 0.75, 0.9})
    EXPECT_NEAR(found.light_of(level), bent(level), 0.01) << level;
}

TEST(MeasureFringeResponse, NeedsAThousandWellModulatedUnsaturatedPixels) {
  const auto error = [](const FrameStack& stack) {
    return error_of([&] { static_cast<void>(measure_fringe_response({&stack, 1})); });
  };
  EXPECT_EQ(error(bent_fringes(8, 100.0)), "");
  // The amplitude of the fundamental of this response is 1.01 times half the range: the least is
  // 7.5 % of 1023 counts.
  EXPECT_EQ(error(bent_fringes(8, 85.0)), "");
  EXPECT_NE(error(bent_fringes(8, 75.0)).find("too few"), std::string::npos);
  EXPECT_NE(error(bent_fringes(8, 540.0)).find("too few"), std::string::npos) << "saturated";
  EXPECT_NE(error(bent_fringes(5, 100.0)).find("six or more"), std::string::npos);
}

TEST(DeterminesResponse, NeedsSixEqualStepsOverATurnInEitherDirection) {
  const auto determines = [](int frames, double step_rad, double error_rad = 0.0) {
    Pattern pattern{.name = "p", .period_px = 40.0};
    for (int k = 0; k < frames; ++k)
      pattern.shifts_rad.push_back(0.7 + step_rad * k);
    pattern.shifts_rad.back() += error_rad;
    return determines_response(pattern);
  };
  EXPECT_TRUE(determines(6, kTwoPi / 6));
  EXPECT_TRUE(determines(9, -kTwoPi / 9));
  EXPECT_FALSE(determines(5, kTwoPi / 5));
  EXPECT_FALSE(determines(6, kTwoPi / 7));
  EXPECT_FALSE(determines(6, kTwoPi / 6, 1e-5));
  EXPECT_TRUE(determines(6, kTwoPi / 6, 1e-8));
  Pattern gray{.name = "g", .kind = PatternKind::Gray};
  gray.shifts_rad.assign(6, 0.0);
  EXPECT_FALSE(determines_response(gray));
}

TEST(ResponseOfWaveform, HasTheHarmonicsOfItsCosineFringes) {
  const FringeWaveform waveform{.harmonics = {{0.15, 0.0}, {-0.02, 0.0}}};
  const ResponseCurve found = response_of_waveform(waveform);
  const double low = waveform.light_at(kPi);
  const double high = waveform.light_at(0.0);
  for (int k = 0; k <= 16; ++k) {
    const double light = waveform.light_at(std::acos(2.0 * k / 16.0 - 1.0));
    EXPECT_NEAR(found.light_of(k / 16.0), (light - low) / (high - low), 1e-9);
  }
}

}  // namespace
}  // namespace frangia
