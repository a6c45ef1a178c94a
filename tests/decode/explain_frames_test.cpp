// Frames of closed formulas with one fault: the cause is named, and sound frames are not blamed.
#include "frangia/decode/explain/explain_frames.h"

#include <algorithm>
#include <functional>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "frangia/core/angles.h"
#include "frangia/decode/explain/find_ceiling.h"
#include "frangia/decode/explain/judge_frames.h"

#include "support/rendered_frames.h"

namespace frangia {
namespace {

using testing::RenderedFrames;
using testing::RenderedScene;
using Change = std::function<void(RenderedFrames&)>;

FrameExplanation explained(const RenderedScene& scene, int steps, const Change& change = {}) {
  RenderedFrames frames(scene, steps);
  if (change) change(frames);
  return explain_frames(frames.stack(), frames.noise());
}

/// Scenes with the nuisances of rule 1: gamma, square fringes, flicker, dim and coarse ones.
std::vector<RenderedScene> scenes() {
  return {{.seed = 1},
          {.gamma = 2.2, .seed = 2},
          {.flicker = 0.03, .seed = 3},
          {.light = 60.0, .gamma = 1.4, .seed = 4},
          {.period_px = 60.0, .binary = true, .seed = 5}};
}

const Change kBlack = [](RenderedFrames& f) {
  std::fill(f.frames[1].begin(), f.frames[1].end(), 6.0);
};
const Change kWhite = [](RenderedFrames& f) {
  std::fill(f.frames[1].begin(), f.frames[1].end(), 400.0);
};
const Change kRepeated = [](RenderedFrames& f) { f.frames[2] = f.frames[1]; };
const Change kExchanged = [](RenderedFrames& f) { std::swap(f.frames[0], f.frames[1]); };
const Change kLate = [](RenderedFrames& f) {
  for (std::size_t k = f.frames.size() - 1; k > 2; --k)
    f.frames[k] = f.frames[k - 1];
};
const Change kHalfTheLight = [](RenderedFrames& f) {
  for (double& light : f.frames[1])
    light *= 0.5;
};
const Change kTorn = [](RenderedFrames& f) {
  std::copy_n(f.frames[1].begin(), f.frames[1].size() / 2, f.frames[2].begin());
};

/// Checks that the cause is named with odds of 100 : 1 in every scene.
void expect_named(const Change& change, int steps, FrameCause cause, const std::string& text) {
  for (const RenderedScene& scene : scenes()) {
    const FrameExplanation found = explained(scene, steps, change);
    EXPECT_TRUE(found.has_fault()) << steps << " steps, seed " << scene.seed;
    EXPECT_EQ(name_of(found.best.cause), name_of(cause)) << steps << " steps, seed " << scene.seed;
    EXPECT_NE(describe(found.explanation).find(text), std::string::npos)
        << steps << " steps, seed " << scene.seed << ": " << describe(found.explanation);
  }
}

TEST(ExplainFrames, FindsSoundFramesToBeAsDescribed) {
  for (const int steps : {3, 4, 5, 6, 12}) {
    for (const RenderedScene& scene : scenes()) {
      const FrameExplanation found = explained(scene, steps);
      EXPECT_TRUE(found.decided);
      EXPECT_EQ(found.best.cause, FrameCause::AsDescribed) << steps << ", seed " << scene.seed;
      EXPECT_LT(found.unexplained_rad, 0.015) << steps << ", seed " << scene.seed;
    }
  }
}

TEST(ExplainFrames, NamesABlackFrame) {
  for (const int steps : {3, 4, 6})
    expect_named(kBlack, steps, FrameCause::Lost, "frame 1 is black");
}

TEST(ExplainFrames, NamesAWhiteFrame) {
  for (const int steps : {3, 4, 6})
    expect_named(kWhite, steps, FrameCause::Lost, "frame 1 is white");
}

TEST(ExplainFrames, NamesARepeatedFrame) {
  expect_named(kRepeated, 6, FrameCause::Repeated, "frame 2 repeats frame 1");
}

TEST(ExplainFrames, NamesExchangedFrames) {
  expect_named(kExchanged, 6, FrameCause::Exchanged, "frames 0 and 1 are exchanged");
}

TEST(ExplainFrames, NamesFramesThatAreLate) {
  expect_named(kLate, 6, FrameCause::Late, "the frames from 3 on are late by one");
}

TEST(ExplainFrames, NamesAFrameOfHalfTheLight) {
  for (const int steps : {5, 6})
    expect_named(kHalfTheLight, steps, FrameCause::Gain, "frame 1 has 0.");
}

TEST(ExplainFrames, NamesATornFrame) {
  expect_named(kTorn, 6, FrameCause::Lost, "frame 2 shows no fringes");
}

TEST(ExplainFrames, NamesAllHypothesesThatFourFramesDoNotTellApart) {
  const FrameExplanation found = explained({.seed = 7}, 4, kRepeated);
  EXPECT_TRUE(found.has_fault());
  EXPECT_GT(found.explanation.best.size(), 1U);
  const FrameVerdict verdict = [] {
    RenderedFrames frames({.seed = 7}, 4);
    kRepeated(frames);
    return judge_frames(frames.stack(), frames.noise(), {.has_other_check = true});
  }();
  EXPECT_EQ(verdict.action, FrameAction::LeaveOutView);
  EXPECT_TRUE(verdict.left_out.empty());
}

TEST(ExplainFrames, SaysThatFramesOfSomethingElseAreNoFringes) {
  const FrameExplanation found = explained({.seed = 8}, 6, [](RenderedFrames& f) {
    for (std::size_t k = 0; k < f.frames.size(); ++k) {
      for (std::size_t i = 0; i < f.frames[k].size(); ++i) {
        const auto x = static_cast<double>(i % 160);
        const auto y = static_cast<double>(i / 160);
        const auto n = static_cast<double>(k);
        f.frames[k][i] =
            120.0 + 100.0 * std::sin(0.05 * (n + 1.0) * x + n) * std::cos(0.04 * (6.0 - n) * y);
      }
    }
  });
  EXPECT_FALSE(found.are_fringes);
  EXPECT_FALSE(found.has_fault());
}

TEST(JudgeFrames, LeavesOutAFrameWhereTheOthersDetermineThePhase) {
  RenderedFrames frames({.seed = 9}, 6);
  kBlack(frames);
  const FrameStack stack = frames.stack();
  const FrameVerdict verdict = judge_frames(stack, frames.noise());
  EXPECT_EQ(verdict.action, FrameAction::LeaveOutFrames);
  EXPECT_EQ(verdict.left_out, std::vector<std::size_t>{1});
  const FrameStack rest = without_frames(stack, verdict.left_out);
  EXPECT_EQ(rest.frames.size(), 5U);
  EXPECT_NEAR(deg_from_rad(rest.pattern.shifts_rad[1]), 120.0, 1e-9);
}

TEST(JudgeFrames, LeavesThreeOfFourFramesOnlyWhereSomethingElseChecksThem) {
  RenderedFrames frames({.seed = 10}, 4);
  kBlack(frames);
  const FrameStack stack = frames.stack();
  EXPECT_EQ(judge_frames(stack, frames.noise()).action, FrameAction::LeaveOutView);
  EXPECT_EQ(judge_frames(stack, frames.noise(), {.has_other_check = true}).action,
            FrameAction::LeaveOutFrames);
}

TEST(JudgeFrames, ReturnsTheShiftsThatLateFramesShow) {
  RenderedFrames frames({.seed = 11}, 8);
  kLate(frames);
  const FrameVerdict verdict = judge_frames(frames.stack(), frames.noise());
  ASSERT_EQ(verdict.remedy_rad.size(), 8U) << name_of(verdict.explanation.best.cause) << ": "
                                           << describe(verdict.explanation.explanation);
  EXPECT_NEAR(deg_from_rad(verdict.remedy_rad[3]), 90.0, 1e-9);
  EXPECT_NEAR(deg_from_rad(verdict.remedy_rad[7]), 270.0, 1e-9);
}

TEST(FrameHypotheses, AreAlikeWithThreeStepsWhereTwoFramesAreExchanged) {
  const Pattern three{.shifts_rad = {0.0, kTwoPi / 3.0, 2.0 * kTwoPi / 3.0}};
  const std::vector<FrameHypothesis> all = frame_hypotheses(three);
  const auto exchanged = std::find_if(all.begin(), all.end(), [](const FrameHypothesis& one) {
    return one.cause == FrameCause::Exchanged;
  });
  EXPECT_TRUE(predict_alike(all.front(), *exchanged));
}

TEST(FindCeiling, FindsVideoLevels) {
  RenderedFrames frames({.light = 300.0, .seed = 12}, 4);
  const FrameStack stack = frames.stack(255, 235.0);
  const auto found = find_ceiling({&stack, 1}, frames.noise());
  ASSERT_TRUE(found);
  EXPECT_EQ(found->counts, 235);
}

TEST(FindCeiling, FindsNoneInFramesThatEndBelowTheWhiteLevel) {
  for (const RenderedScene& scene : scenes()) {
    RenderedFrames frames(scene, 4);
    const FrameStack stack = frames.stack();
    EXPECT_FALSE(find_ceiling({&stack, 1}, frames.noise())) << scene.seed;
  }
}

}  // namespace
}  // namespace frangia
