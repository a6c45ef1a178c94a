#include "frangia/phase/wrap/decode_sequence.h"

#include <cmath>
#include <cstdint>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "frangia/core/angles.h"
#include "frangia/core/error.h"
#include "frangia/pattern/fringe_sequence.h"
#include "frangia/phase/temporal/unwrap_sequence.h"

#include "support/synthetic_fringes.h"

namespace frangia {
namespace {

using testing::render_frames;

constexpr int kWidth = 640;
constexpr int kHeight = 40;
constexpr double kNoise_counts = 600.0;
const NoiseModel kNoise{.floor_counts2 = kNoise_counts * kNoise_counts};

Projector display() {
  Projector projector;
  projector.model = CameraModel{.width_px = kWidth, .height_px = 4, .focal_px = {800.0, 800.0}};
  return projector;
}

std::vector<FrameStack> frames_of(const std::string& sequence, int shifts) {
  std::vector<FrameStack> stacks;
  for (const double fringes : fringe_sequence(sequence, 64.0)) {
    const Pattern pattern{.name = "p",
                          .period_px = kWidth / fringes,
                          .shifts_rad = testing::equal_shifts(shifts, kTwoPi / shifts)};
    const testing::Scene scene{.width = kWidth,
                               .height = kHeight,
                               .noise_counts = kNoise_counts,
                               .seed = static_cast<std::uint32_t>(stacks.size() + 1)};
    stacks.push_back(
        render_frames(scene, pattern, [&](int x, int) { return kTwoPi * fringes * x / kWidth; }));
  }
  // A highlight in one frame and a shadow in all frames of one map.
  std::get<Image<std::uint16_t>>(stacks[2].frames[1])(300, 7) = 65535;
  for (Frame& frame : stacks[1].frames)
    std::get<Image<std::uint16_t>>(frame)(301, 8) = 900;
  return stacks;
}

std::vector<SequenceFrames> maps_of(const std::vector<FrameStack>& stacks) {
  std::vector<SequenceFrames> maps;
  maps.reserve(stacks.size());
  for (const FrameStack& stack : stacks)
    maps.push_back({&stack, least_squares(stack.pattern.shifts_rad)});
  return maps;
}

TEST(DecodeSequence, EqualsWrappingEachMapAndUnwrapping) {
  for (const char* name : {"doubling", "negative-exponential", "heterodyne"}) {
    for (const int shifts : {3, 4, 5, 6}) {
      const auto stacks = frames_of(name, shifts);
      const AbsolutePhase once = decode_sequence(maps_of(stacks), kNoise, display());
      std::vector<WrappedPhase> wrapped;
      wrapped.reserve(stacks.size());
      for (const FrameStack& stack : stacks)
        wrapped.push_back(wrap_phase(stack, least_squares(stack.pattern.shifts_rad), kNoise));
      const AbsolutePhase apart = unwrap_sequence(wrapped, display(), SequenceMethod::Levels);
      for (int y = 0; y < kHeight; ++y) {
        for (int x = 0; x < kWidth; ++x) {
          ASSERT_EQ(once.status(x, y), apart.status(x, y)) << name << ' ' << x << ' ' << y;
          if (once.status(x, y) != PixelStatus::Measured) continue;
          ASSERT_NEAR(once.phase_rad(x, y), apart.phase_rad(x, y), 1e-4);
          ASSERT_NEAR(once.sigma_rad(x, y) / apart.sigma_rad(x, y), 1.0, 1e-4);
        }
      }
    }
  }
}

TEST(DecodeSequence, MatchesItsSigmaAndReportsWhyPixelsAreMissing) {
  const auto stacks = frames_of("negative-exponential", 4);
  const AbsolutePhase phase = decode_sequence(maps_of(stacks), kNoise, display());
  double chi_square = 0.0;
  double count = 0.0;
  for (int y = 0; y < kHeight; ++y) {
    for (int x = 100; x < kWidth - 100; ++x) {
      if (phase.status(x, y) != PixelStatus::Measured) continue;
      const double error = phase.phase_rad(x, y) - kTwoPi * 64.0 * x / kWidth;
      chi_square += std::pow(error / static_cast<double>(phase.sigma_rad(x, y)), 2);
      count += 1.0;
    }
  }
  EXPECT_GT(count, 0.99 * (kWidth - 200) * kHeight);
  EXPECT_NEAR(chi_square / count, 1.0, 0.05);
  EXPECT_EQ(phase.status(300, 7), PixelStatus::Saturated);
  EXPECT_EQ(phase.status(301, 8), PixelStatus::Unmodulated);
  EXPECT_TRUE(std::isnan(phase.phase_rad(300, 7)));
}

TEST(DecodeSequence, ReusesTheMemoryOfARecycledPhase) {
  const auto stacks = frames_of("doubling", 4);
  AbsolutePhase first = decode_sequence(maps_of(stacks), kNoise, display());
  const AbsolutePhase kept = first;
  const float* memory = first.phase_rad.pixels().data();
  const AbsolutePhase again =
      decode_sequence(maps_of(stacks), kNoise, display(), {}, std::move(first));
  EXPECT_EQ(again.phase_rad.pixels().data(), memory);
  EXPECT_EQ(again.status(200, 20), kept.status(200, 20));
  EXPECT_EQ(again.phase_rad(200, 20), kept.phase_rad(200, 20));
}

TEST(DecodeSequence, RefusesFramesThatDetermineNoAbsolutePhase) {
  auto stacks = frames_of("doubling", 4);
  EXPECT_THROW(static_cast<void>(decode_sequence({}, kNoise, display())), Error);
  const auto finest = maps_of(stacks);
  EXPECT_THROW(static_cast<void>(decode_sequence(std::span(finest).subspan(5), kNoise, display())),
               Error);
  stacks[3].pattern.period_px = std::nan("");
  EXPECT_THROW(static_cast<void>(decode_sequence(maps_of(stacks), kNoise, display())), Error);
}

}  // namespace
}  // namespace frangia
