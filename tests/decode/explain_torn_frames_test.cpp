// Frames of which a part shows what is shown one frame before or later; made by formulas.
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <random>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "frangia/core/angles.h"
#include "frangia/decode/decode_view.h"
#include "frangia/decode/explain/explain_lag.h"

namespace frangia {
namespace {

constexpr int kTornWidth_px = 320;
constexpr int kTornHeight_px = 120;

/// Patterns of 1280, 160 and 20 px, whose rows from `begin` up to `end` are late by `lag`.
std::vector<FrameStack> torn_frames(int steps, int lag, int begin, int end, double harmonic = 0.0) {
  std::mt19937 generator(3);
  std::normal_distribution<double> noise(0.0, 1.5);
  std::vector<FrameStack> stacks;
  std::vector<std::pair<double, double>> shown;  // period, shift
  for (const double period_px : {1280.0, 160.0, 20.0}) {
    FrameStack stack;
    stack.pattern = {.name = std::to_string(static_cast<int>(period_px)), .period_px = period_px};
    stack.pattern.shifts_rad.clear();
    for (int k = 0; k < steps; ++k) {
      stack.pattern.shifts_rad.push_back(kTwoPi * k / steps);
      shown.emplace_back(period_px, kTwoPi * k / steps);
    }
    stacks.push_back(std::move(stack));
  }
  int number = 0;
  for (FrameStack& stack : stacks) {
    for (int k = 0; k < steps; ++k, ++number) {
      Image<std::uint8_t> image(kTornWidth_px, kTornHeight_px);
      for (int y = 0; y < kTornHeight_px; ++y) {
        const int place = number - (y >= begin && y < end ? lag : 0);
        const bool is_shown = place >= 0 && place < static_cast<int>(shown.size());
        for (int x = 0; x < kTornWidth_px; ++x) {
          double counts = 12.0;
          if (is_shown) {
            const auto [period_px, shift_rad] = shown[static_cast<std::size_t>(place)];
            const double column = 60.0 + 2.5 * x + 8.0 * std::sin(0.03 * x + 0.1 * y);
            const double phase = kTwoPi * column / period_px + shift_rad;
            const double bright = 60.0 + 30.0 * std::cos(0.013 * x + 0.05 * y);
            counts += bright * (1.0 + 0.8 * std::cos(phase) + harmonic * std::cos(2.0 * phase));
          }
          image(x, y) = static_cast<std::uint8_t>(
              std::lround(std::clamp(counts + noise(generator), 0.0, 254.0)));
        }
      }
      stack.frames.emplace_back(std::move(image));
    }
  }
  return stacks;
}

TEST(ExplainTornFrames, FindsTheRowAndTheSideThatIsOutOfStep) {
  for (const int steps : {3, 4, 6, 12}) {
    for (const int lag : {1, -1}) {
      for (const int row : {20, 96}) {
        for (const bool above : {true, false}) {
          const auto found = explain_torn_frames(
              torn_frames(steps, lag, above ? 0 : row, above ? row : kTornHeight_px));
          ASSERT_TRUE(found) << steps << " " << lag << " " << row << " " << above;
          EXPECT_EQ(found->frames, lag);
          EXPECT_EQ(found->part, above ? LagPart::Above : LagPart::Below);
          EXPECT_NEAR(found->row_px, row, 5) << steps << " " << lag << " " << above;
        }
      }
    }
  }
}

TEST(ExplainTornFrames, BlamesNoFramesThatAreWhole) {
  for (const int steps : {3, 4, 6, 12}) {
    for (const double harmonic : {0.0, 0.12, 0.3})
      EXPECT_FALSE(explain_torn_frames(torn_frames(steps, 0, 0, 0, harmonic))) << steps;
    EXPECT_FALSE(explain_torn_frames(torn_frames(steps, 1, 0, kTornHeight_px))) << steps;
    // A frame of which a part is lost.
    std::vector<FrameStack> lost = torn_frames(steps, 0, 0, 0);
    const auto pixels = std::get<Image<std::uint8_t>>(lost[1].frames[1]).pixels();
    std::fill(pixels.begin(), pixels.begin() + std::ssize(pixels) / 3, std::uint8_t{12});
    EXPECT_FALSE(explain_torn_frames(lost)) << steps;
  }
}

TEST(ExplainTornFrames, LeavesOutTheView) {
  Rig rig;
  rig.reference().model.width_px = kTornWidth_px;
  rig.reference().model.height_px = kTornHeight_px;
  rig.projector.model = CameraModel{.width_px = 1280, .height_px = 800};
  for (const int steps : {3, 6}) {
    const DecodedView view = decode_view(torn_frames(steps, 1, 0, 40), rig, {}, {});
    const std::string text = misfit_of(view);
    EXPECT_NE(text.find("torn at about row"), std::string::npos) << text;
    EXPECT_NE(text.find("above it each shows what should be seen one frame before"),
              std::string::npos)
        << text;
    EXPECT_FALSE(view.directions.front().check->consistent);
  }
}

}  // namespace
}  // namespace frangia
