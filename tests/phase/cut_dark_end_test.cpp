// A camera whose black level is too low, by closed formulas: the level is found, the phase is that
// of fringes that are not cut off, and no sound frames are taken for such.
#include "frangia/phase/waveform/cut_dark_end.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <variant>

#include <gtest/gtest.h>

#include "frangia/core/angles.h"
#include "frangia/phase/algorithm/phase_algorithm.h"
#include "frangia/phase/wrap/wrap_phase.h"

#include "support/rendered_frames.h"

namespace frangia {
namespace {

using testing::RenderedFrames;
using testing::RenderedScene;

/// RMS errors of the phase, in rad and over its sigma, and the measured share of the lit pixels.
struct PhaseErrors {
  double rms_rad = 0.0;
  double over_sigma = 0.0;
  double measured = 0.0;
};

PhaseErrors errors_of(const FrameStack& stack,
                      const NoiseModel& noise,
                      const RenderedFrames& truth) {
  const WrappedPhase map = wrap_phase(stack, least_squares(stack.pattern.shifts_rad), noise);
  PhaseErrors out;
  double count = 0.0;
  double lit = 0.0;
  for (int y = 0; y < map.phase_rad.height(); ++y) {
    for (int x = 45; x < map.phase_rad.width(); ++x) {
      lit += 1.0;
      const double found = map.phase_rad(x, y);
      if (std::isnan(found)) continue;
      const double error = wrap_rad(found - truth.phase(x, y));
      out.rms_rad += error * error;
      out.over_sigma += std::pow(error / map.sigma_rad(x, y), 2);
      count += 1.0;
    }
  }
  return {std::sqrt(out.rms_rad / count), std::sqrt(out.over_sigma / count), count / lit};
}

/// The frames of a camera that shows nothing below `level`.
FrameStack cut_at(FrameStack stack, int level) {
  for (Frame& frame : stack.frames)
    for (std::uint8_t& counts : std::get<Image<std::uint8_t>>(frame).pixels())
      counts = static_cast<std::uint8_t>(std::max<int>(counts, level));
  return stack;
}

TEST(CutDarkEnd, IsFoundAndThePhaseIsThatOfTheOtherSamples) {
  for (const int steps : {3, 4, 5, 6, 8, 12}) {
    for (const double black : {-14.0, -30.0}) {
      RenderedFrames frames({.ambient = black, .light = 230.0, .seed = 4}, steps);
      const FrameStack stack = frames.stack();
      const auto found = find_cut_dark_end({&stack, 1}, frames.noise());
      ASSERT_TRUE(found) << steps << " steps, " << black;
      EXPECT_EQ(found->counts, 0);
      EXPECT_NEAR(found->depth_counts, -black, 0.35 * -black) << steps << " steps";
      const RaisedFrames raised = raise_dark_end({&stack, 1}, *found, frames.noise());
      const PhaseErrors before = errors_of(stack, frames.noise(), frames);
      const PhaseErrors after = errors_of(raised.stacks.front(), raised.noise, frames);
      constexpr int kMany = 8;  // in which harmonics of the cut cancel
      EXPECT_LT(after.rms_rad, (steps < kMany ? 0.6 : 1.0) * before.rms_rad)
          << steps << " steps, " << black;
      EXPECT_LT(after.over_sigma, 1.3) << steps << " steps, " << black;
      EXPECT_GT(after.over_sigma, 0.7) << steps << " steps, " << black;
      EXPECT_GT(after.measured, 0.92) << steps << " steps, " << black;
    }
  }
}

TEST(CutDarkEnd, IsFoundAtTheBlackOfVideoLevels) {
  RenderedFrames frames({.ambient = -4.0, .seed = 5}, 4);
  const FrameStack stack = cut_at(frames.stack(), 16);
  const auto found = find_cut_dark_end({&stack, 1}, frames.noise());
  ASSERT_TRUE(found);
  EXPECT_EQ(found->counts, 16);
  const RaisedFrames raised = raise_dark_end({&stack, 1}, *found, frames.noise());
  EXPECT_LT(errors_of(raised.stacks.front(), raised.noise, frames).over_sigma, 1.3);
}

TEST(CutDarkEnd, IsNotFoundInSoundFramesInADarkRoom) {
  for (const int steps : {3, 4, 6, 8}) {
    for (const RenderedScene& scene : {RenderedScene{.ambient = 0.0, .seed = 1},
                                       RenderedScene{.ambient = 0.5, .gamma = 2.2, .seed = 2},
                                       RenderedScene{.ambient = 0.0, .gamma = 3.0, .seed = 3},
                                       RenderedScene{.ambient = 0.0, .light = 20.0, .seed = 4},
                                       RenderedScene{.ambient = 0.0, .binary = true, .seed = 5},
                                       RenderedScene{.ambient = 0.0, .flicker = 0.03, .seed = 6},
                                       RenderedScene{.ambient = 0.0, .noise = 0.4, .seed = 7}}) {
      RenderedFrames frames(scene, steps);
      const FrameStack stack = frames.stack();
      EXPECT_FALSE(find_cut_dark_end({&stack, 1}, frames.noise()))
          << steps << " steps, seed " << scene.seed;
    }
  }
}

TEST(CutDarkEnd, IsNotFoundInFramesOfMoreBits) {
  RenderedFrames frames({.ambient = 0.0, .seed = 8}, 4);
  FrameStack stack = frames.stack();
  constexpr int kFactor = 16;  // 12 bits, whose noise is many counts
  std::uint32_t state = 1;
  for (Frame& frame : stack.frames) {
    const auto& image = std::get<Image<std::uint8_t>>(frame);
    Image<std::uint16_t> finer(image.width(), image.height());
    for (std::size_t i = 0; i < finer.pixels().size(); ++i) {
      state = state * 1664525U + 1013904223U;
      const int below = static_cast<int>(state >> 28U) - kFactor / 2;
      finer.pixels()[i] =
          static_cast<std::uint16_t>(std::max(0, kFactor * image.pixels()[i] + below));
    }
    frame = finer;
  }
  stack.white_level = 4095;
  NoiseModel noise = frames.noise();
  noise.floor_counts2 *= kFactor * kFactor;
  noise.slope_counts *= kFactor;
  EXPECT_FALSE(find_cut_dark_end({&stack, 1}, noise));
}

TEST(CutDarkEnd, IsNotFoundBesideABlackFrame) {
  for (const int steps : {3, 4, 6}) {
    RenderedFrames frames({.seed = 9}, steps);
    std::fill(frames.frames[1].begin(), frames.frames[1].end(), 0.0);
    const FrameStack stack = frames.stack();
    EXPECT_FALSE(find_cut_dark_end({&stack, 1}, frames.noise())) << steps;
  }
}

}  // namespace
}  // namespace frangia
