// Causes that resemble each other, by closed formulas: the right one is named, or both.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string>
#include <variant>
#include <vector>

#include <gtest/gtest.h>

#include "frangia/core/angles.h"
#include "frangia/decode/explain/explain_frames.h"
#include "frangia/decode/explain/judge_frames.h"

#include "support/rendered_frames.h"

namespace frangia {
namespace {

using testing::RenderedFrames;
using testing::RenderedScene;

TEST(ConfusedCauses, AFrameOfFourFifthsOfTheLightIsNoFlicker) {
  for (const int steps : {5, 6, 8}) {
    for (const unsigned seed : {1U, 2U, 3U}) {
      RenderedFrames frames({.ambient = 0.5, .seed = seed}, steps);
      for (double& light : frames.frames[2])
        light *= 0.8;
      const FrameExplanation found = explain_frames(frames.stack(), frames.noise());
      EXPECT_TRUE(found.has_fault()) << steps << " steps, seed " << seed;
      EXPECT_EQ(name_of(found.best.cause), name_of(FrameCause::Gain))
          << steps << " steps, seed " << seed << ": " << describe(found.explanation);
    }
  }
}

/// The frames as a lamp beside the projector lights them from frame 2 on: as the albedo.
void light_by_lamp(RenderedFrames& frames) {
  for (std::size_t i = 0; i < frames.frames[0].size(); ++i) {
    double brightest = 0.0;
    for (const auto& frame : frames.frames)
      brightest = std::max(brightest, frame[i]);
    for (std::size_t k = 2; k < frames.frames.size(); ++k)
      frames.frames[k][i] += 0.15 * brightest;
  }
}

TEST(ConfusedCauses, ALampIsNoUnevenSteps) {
  // Gains of the frames and errors of their steps together show nearly what a lamp does.
  for (const int steps : {6, 8}) {
    for (const unsigned seed : {1U, 2U, 3U}) {
      RenderedFrames frames({.ambient = 20.0, .light = 150.0, .seed = seed}, steps);
      light_by_lamp(frames);
      const FrameExplanation found = explain_frames(frames.stack(), frames.noise());
      EXPECT_TRUE(found.has_fault()) << steps << " steps, seed " << seed;
      EXPECT_EQ(name_of(found.best.cause), name_of(FrameCause::Lamp))
          << steps << " steps, seed " << seed << ": " << describe(found.explanation);
    }
  }
}

TEST(ConfusedCauses, FlickerThatTheRoomDoesNotShareIsNoFault) {
  constexpr std::array kGains = {
      1.009, 0.974, 0.992, 0.976, 1.066, 0.994, 0.967, 1.021, 0.985, 1.03, 1.012, 0.973};
  for (const int steps : {5, 6, 8, 12}) {
    for (const double gamma : {1.0, 1.6, 2.2}) {
      for (const double ambient : {10.0, 40.0}) {
        const RenderedScene scene{.ambient = 0.0, .light = 150.0, .gamma = gamma};
        RenderedFrames frames(scene, steps);
        for (std::size_t k = 0; k < frames.frames.size(); ++k)
          for (double& light : frames.frames[k])
            light = ambient + kGains.at(k) * light;
        const FrameExplanation found = explain_frames(frames.stack(), frames.noise());
        EXPECT_FALSE(found.has_fault()) << steps << " steps, gamma " << gamma << ", " << ambient
                                        << " counts: " << describe(found.explanation);
      }
    }
  }
}

/// The verdict on five frames of which two were shown too far, by these angles.
FrameVerdict judge_five(double third_deg, double fourth_deg) {
  RenderedFrames frames({.seed = 27}, {0.0, 72.0, 144.0 + third_deg, 216.0 + fourth_deg, 288.0});
  FrameStack stack = frames.stack();
  for (std::size_t k = 0; k < 5; ++k)
    stack.pattern.shifts_rad[k] = kTwoPi * static_cast<double>(k) / 5.0;
  return judge_frames(stack, frames.noise());
}

TEST(ConfusedCauses, UnevenStepsOfFiveFramesAreNoLamp) {
  const FrameVerdict verdict = judge_five(10.0, -6.0);
  EXPECT_EQ(verdict.explanation.best.cause, FrameCause::Steps) << verdict.finding;
  EXPECT_TRUE(verdict.explanation.has_fault());
}

TEST(ConfusedCauses, UnevenStepsOfFiveFramesThatMayBeFlickerAreCounted) {
  // As frames whose light flickers by 7 % in a room that is half as bright.
  const FrameVerdict verdict = judge_five(7.0, -4.0);
  EXPECT_FALSE(verdict.explanation.has_fault()) << verdict.finding;
  const double error_rad = rad_from_deg(std::sqrt(2.0 / 5.0 * (49.0 + 16.0 - 9.0 / 5.0) / 5.0));
  EXPECT_NEAR(verdict.explanation.unexplained_rad, error_rad, 0.3 * error_rad);
}

TEST(ConfusedCauses, StepsOfFourFramesThatAreTooLongAreNoMovedPart) {
  RenderedFrames coarse({.period_px = 90.0, .seed = 3}, 4);
  FrameStack reference = coarse.stack();
  reference.pattern.name = "coarse";
  reference.pattern.period_px = 200.0;
  const std::array<const FrameStack*, 1> references{&reference};
  for (const double factor : {0.93, 1.05}) {
    RenderedFrames frames({.seed = 3}, {0.0, 90.0 * factor, 180.0 * factor, 270.0 * factor});
    FrameStack stack = frames.stack();
    for (std::size_t k = 0; k < 4; ++k)
      stack.pattern.shifts_rad[k] = 0.25 * kTwoPi * static_cast<double>(k);
    const FrameVerdict verdict =
        judge_frames(stack, frames.noise(), {.has_other_check = true, .references = references});
    EXPECT_EQ(name_of(verdict.explanation.best.cause), name_of(FrameCause::Steps))
        << factor << ": " << verdict.finding;
    ASSERT_EQ(verdict.remedy_rad.size(), 4U) << factor << ": " << verdict.finding;
    EXPECT_NEAR(deg_from_rad(verdict.remedy_rad[3] - verdict.remedy_rad[0]), 270.0 * factor, 1.5);
  }
}

TEST(ConfusedCauses, AnOuterFrameThatIsDisplacedIsAPartThatMovedBesideIt) {
  for (const int steps : {4, 5, 6}) {
    for (const bool is_last : {false, true}) {
      RenderedFrames frames({.seed = 6}, steps);
      for (std::vector<double>& frame : frames.frames) {  // as a lens blurs it
        const std::vector<double> sharp = frame;
        for (std::size_t i = 1; i + 1 < sharp.size(); ++i)
          frame[i] = 0.25 * sharp[i - 1] + 0.5 * sharp[i] + 0.25 * sharp[i + 1];
      }
      std::vector<double>& outer = is_last ? frames.frames.back() : frames.frames.front();
      std::rotate(outer.begin(), outer.begin() + 1, outer.end());
      const FrameVerdict verdict =
          judge_frames(frames.stack(), frames.noise(), {.has_other_check = true});
      const FrameExplanation& found = verdict.explanation;
      EXPECT_TRUE(found.has_fault()) << steps << ": " << describe(found.explanation);
      for (const FrameCause cause : {FrameCause::Displaced, FrameCause::Moved}) {
        EXPECT_TRUE(std::any_of(found.alike.begin(),
                                found.alike.end(),
                                [&](const auto& one) { return one.cause == cause; }))
            << steps << ": " << describe(found.explanation);
      }
      // A part that moved behind the first frame is elsewhere in all others.
      const std::vector<std::size_t> left_out =
          is_last ? std::vector<std::size_t>{static_cast<std::size_t>(steps) - 1}
                  : std::vector<std::size_t>{};
      EXPECT_EQ(verdict.left_out, left_out) << steps << ": " << verdict.finding;
    }
  }
}

TEST(ConfusedCauses, FramesOfFewLevelsAreNotCovered) {
  for (const int steps : {4, 6}) {
    for (const unsigned seed : {1U, 2U, 3U}) {
      RenderedFrames frames({.shadow = 0.4, .seed = seed}, steps);
      FrameStack stack = frames.stack();
      constexpr int kCounts = 8;  // of a level
      for (Frame& frame : stack.frames)
        for (std::uint8_t& count : std::get<Image<std::uint8_t>>(frame).pixels())
          count = static_cast<std::uint8_t>(count / kCounts * kCounts + kCounts / 2);
      const FrameExplanation found = explain_frames(stack, frames.noise());
      EXPECT_FALSE(found.has_fault())
          << steps << " steps, seed " << seed << ": " << describe(found.explanation);
    }
  }
}

}  // namespace
}  // namespace frangia
