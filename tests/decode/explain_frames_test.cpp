// Frames of closed formulas with one fault: the cause is named, and sound frames are not blamed.
#include "frangia/decode/explain/explain_frames.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <string>
#include <variant>
#include <vector>

#include <gtest/gtest.h>

#include "frangia/core/angles.h"
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

TEST(ExplainFrames, NamesALampOnAPartThatIsNarrowerThanTheBlocksOfAnImageAreApart) {
  const FrameExplanation found =
      explained({.width = 960, .height = 400, .shadow = 0.0}, 6, [](RenderedFrames& f) {
        for (std::size_t k = 0; k < f.frames.size(); ++k) {
          for (std::size_t i = 0; i < f.frames[k].size(); ++i) {
            const std::size_t x = i % 960;
            double& light = f.frames[k][i];
            if (x < 430 || x >= 530)
              light = 6.0;
            else if (k >= 3)
              light += 40.0;
          }
        }
      });
  EXPECT_EQ(name_of(found.best.cause), name_of(FrameCause::Lamp)) << describe(found.explanation);
  EXPECT_EQ(found.best.lamp_on, 3U);
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

TEST(ExplainFrames, NamesARepeatedFrameOfThree) {
  // All lit pixels are alike in two of three frames: that is no background of one lit frame.
  for (const RenderedScene& scene : scenes()) {
    const FrameExplanation found = explained(scene, 3, kRepeated);
    EXPECT_TRUE(found.has_fault()) << "seed " << scene.seed;
    EXPECT_EQ(found.best.cause, FrameCause::Repeated) << describe(found.explanation);
  }
}

TEST(ExplainFrames, NamesARepeatedFrameOfFringesThatRepeatWhereverBlocksOfAGridWouldLie) {
  RenderedFrames frames({.width = 560, .height = 400, .seed = 3}, 4);
  FrameStack stack = frames.stack();
  constexpr int kGrid = 40;  // 560 px over 14 blocks, and twice the period
  for (std::size_t k = 0; k < stack.frames.size(); ++k) {
    auto& image = std::get<Image<std::uint8_t>>(stack.frames[k]);
    const double shift = 0.5 * kPi * static_cast<double>(k == 2 ? 1 : k);
    for (int y = 0; y < image.height(); ++y)
      for (int x = 0; x < image.width(); ++x)
        image(x, y) = static_cast<std::uint8_t>(
            std::lround(100.0 + 80.0 * std::cos(2.0 * kTwoPi * x / kGrid + shift)));
  }
  const FrameExplanation found = explain_frames(stack, frames.noise());
  EXPECT_TRUE(found.decided);
  EXPECT_EQ(found.best.cause, FrameCause::Repeated) << describe(found.explanation);
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

TEST(ExplainFrames, NamesAFrameOfHalfTheLightOfTheProjectorInALitRoom) {
  for (const int steps : {5, 6, 12}) {
    const FrameExplanation found =
        explained({.ambient = 45.0, .light = 150.0, .seed = 33}, steps, [](RenderedFrames& f) {
          for (double& light : f.frames[1])
            light = 45.0 + 0.5 * (light - 45.0);
        });
    EXPECT_TRUE(found.has_fault()) << steps;
    EXPECT_EQ(name_of(found.best.cause), name_of(FrameCause::Gain))
        << steps << ": " << describe(found.explanation);
  }
}

TEST(ExplainFrames, NamesATornFrame) {
  expect_named(kTorn, 6, FrameCause::Lost, "frame 2 shows no fringes");
}

TEST(ExplainFrames, NoFrameHidesItselfByTheBackgroundThatItLights) {
  for (const int steps : {5, 6}) {
    for (const unsigned seed : {21U, 22U}) {
      const FrameExplanation found =
          explained({.shadow = 0.7, .seed = seed}, steps, [](RenderedFrames& f) {
            for (double& light : f.frames[1])
              light += 60.0;
          });
      EXPECT_TRUE(found.has_fault()) << steps;
      EXPECT_EQ(found.best.cause, FrameCause::Lamp) << steps << describe(found.explanation);
      // With five steps that is the same as a lamp in the frames opposite of it.
      EXPECT_NE(describe(found.explanation).find("another lamp lit frame 1 alone"),
                std::string::npos)
          << describe(found.explanation);
      EXPECT_EQ(found.explanation.best.size(), steps == 5 ? 2U : 1U);
    }
  }
}

TEST(ExplainFrames, TellsALostFrameOfFiveFromALamp) {
  for (const std::size_t frame : {1U, 3U}) {
    for (const double counts : {6.0, 400.0}) {
      const FrameExplanation found = explained({.seed = 23}, 5, [&](RenderedFrames& f) {
        std::fill(f.frames[frame].begin(), f.frames[frame].end(), counts);
      });
      EXPECT_EQ(found.best.cause, FrameCause::Lost) << frame << describe(found.explanation);
      EXPECT_EQ(found.best.frames, std::vector<std::size_t>{frame});
    }
  }
}

TEST(ExplainFrames, NamesALampOf25Counts) {
  for (const int steps : {5, 6}) {
    const FrameExplanation found = explained({.seed = 24}, steps, [](RenderedFrames& f) {
      for (std::size_t k = 3; k < f.frames.size(); ++k)
        for (double& light : f.frames[k])
          light += 25.0;
    });
    EXPECT_TRUE(found.has_fault()) << steps;
    EXPECT_EQ(found.best.cause, FrameCause::Lamp) << steps << describe(found.explanation);
    EXPECT_EQ(found.best.lamp_on, 3U) << steps;
  }
}

TEST(ExplainFrames, BlamesNothingForACameraWithAResponseThatSeesOneSideOfAFringe) {
  for (const int steps : {3, 4, 5, 6}) {
    for (const double period_px : {350.0, 500.0}) {
      for (const unsigned seed : {1U, 2U, 3U}) {
        const RenderedScene scene{.period_px = period_px, .ambient = 8.0, .seed = seed};
        const FrameExplanation found = explained(scene, steps, [](RenderedFrames& f) {
          for (auto& frame : f.frames) {
            for (double& light : frame)
              light = 255.0 * std::pow(light / 255.0, 1.0 / 2.2);
          }
        });
        EXPECT_FALSE(found.has_fault()) << steps << " " << describe(found.explanation);
      }
    }
  }
}

TEST(ExplainFrames, NamesAFrameOfTheMeanOfTheOthers) {
  for (const int steps : {4, 6}) {
    const FrameExplanation found = explained({.seed = 25}, steps, [](RenderedFrames& f) {
      std::vector<double> mean(f.frames[0].size());
      for (const auto& frame : f.frames)
        for (std::size_t i = 0; i < mean.size(); ++i)
          mean[i] += frame[i] / static_cast<double>(f.frames.size());
      f.frames[1] = mean;
    });
    EXPECT_TRUE(found.has_fault()) << steps;
    EXPECT_EQ(found.best.cause, FrameCause::Lost) << steps << describe(found.explanation);
  }
}

TEST(ExplainFrames, NamesAPartThatMoved) {
  const FrameExplanation found = explained({.seed = 26}, 6, [](RenderedFrames& f) {
    for (auto& frame : f.frames) {  // as a lens blurs it
      const std::vector<double> sharp = frame;
      for (std::size_t i = 1; i + 1 < sharp.size(); ++i)
        frame[i] = 0.25 * sharp[i - 1] + 0.5 * sharp[i] + 0.25 * sharp[i + 1];
    }
    for (std::size_t k = 3; k < f.frames.size(); ++k)
      for (std::size_t i = f.frames[k].size() - 1; i > 0; --i)  // 1 px along x
        f.frames[k][i] = f.frames[k][i - 1];
  });
  EXPECT_TRUE(found.has_fault());
  EXPECT_EQ(found.best.cause, FrameCause::Moved) << describe(found.explanation);
  EXPECT_EQ(found.best.frames, std::vector<std::size_t>{3});
}

TEST(JudgeFrames, ReturnsTheShiftsOfUnevenSteps) {
  const std::vector<double> shown_deg{0.0, 60.0, 128.0, 180.0, 240.0, 300.0};
  RenderedFrames frames({.seed = 27}, shown_deg);
  FrameStack stack = frames.stack();
  for (std::size_t k = 0; k < shown_deg.size(); ++k)
    stack.pattern.shifts_rad[k] = kTwoPi * static_cast<double>(k) / 6.0;
  const FrameVerdict verdict = judge_frames(stack, frames.noise());
  EXPECT_EQ(verdict.explanation.best.cause, FrameCause::Steps) << verdict.finding;
  ASSERT_EQ(verdict.remedy_rad.size(), shown_deg.size()) << verdict.finding;
  EXPECT_NEAR(deg_from_rad(verdict.remedy_rad[2] - verdict.remedy_rad[1]), 68.0, 1.5);
}

TEST(JudgeFrames, TakesNoFrameForExact) {
  // The first frame is off: the start of the fringes moves by a sixth of it.
  const std::vector<double> shown_deg{8.0, 60.0, 120.0, 180.0, 240.0, 300.0};
  RenderedFrames frames({.seed = 27}, shown_deg);
  FrameStack stack = frames.stack();
  for (std::size_t k = 0; k < shown_deg.size(); ++k)
    stack.pattern.shifts_rad[k] = kTwoPi * static_cast<double>(k) / 6.0;
  const std::vector<double> stated = stack.pattern.shifts_rad;
  const FrameVerdict verdict = judge_frames(stack, frames.noise());
  ASSERT_EQ(verdict.remedy_rad.size(), shown_deg.size()) << verdict.finding;
  double mean = 0.0;
  for (std::size_t k = 0; k < stated.size(); ++k)
    mean += deg_from_rad(verdict.remedy_rad[k] - stated[k]) / 6.0;
  EXPECT_NEAR(mean, 0.0, 0.1);
  EXPECT_NEAR(deg_from_rad(verdict.remedy_rad[1] - verdict.remedy_rad[0]), 52.0, 1.5);
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

TEST(FindCeiling, FindsNoneInBlackFrames) {
  RenderedFrames frames({.light = 300.0, .seed = 12}, 4);
  const FrameStack stack = frames.stack(255, 0.0);
  EXPECT_FALSE(find_ceiling({&stack, 1}, {.floor_counts2 = 1.0}));
}

}  // namespace
}  // namespace frangia
