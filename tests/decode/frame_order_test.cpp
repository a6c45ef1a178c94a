// Frames in the order of their names, and projectors that are late where the pattern changes.
#include <cstddef>
#include <vector>

#include <gtest/gtest.h>

#include "frangia/core/angles.h"
#include "frangia/decode/explain/judge_frames.h"

#include "support/rendered_frames.h"

namespace frangia {
namespace {

using testing::RenderedFrames;

TEST(JudgeFrames, NamesTheAlphabeticalOrderOfTheNumbersOfTheFrames) {
  for (const bool from_one : {false, true}) {
    RenderedFrames frames({.seed = 5}, 12);
    const auto shown = frames.frames;
    const std::vector<std::size_t> order =
        from_one ? std::vector<std::size_t>{0, 9, 10, 11, 1, 2, 3, 4, 5, 6, 7, 8}
                 : std::vector<std::size_t>{0, 1, 10, 11, 2, 3, 4, 5, 6, 7, 8, 9};
    for (std::size_t k = 0; k < order.size(); ++k)
      frames.frames[k] = shown[order[k]];
    const FrameVerdict verdict = judge_frames(frames.stack(), frames.noise());
    EXPECT_EQ(name_of(verdict.explanation.best.cause), "sorted") << verdict.finding;
    ASSERT_EQ(verdict.remedy_rad.size(), 12U) << verdict.finding;
    EXPECT_NEAR(deg_from_rad(verdict.remedy_rad[2]), 300.0, 1e-9);
  }
}

TEST(JudgeFirstFrame, NamesTheLastFrameOfThePatternBefore) {
  for (const int steps : {3, 4, 6}) {
    RenderedFrames before({.period_px = 50.0, .seed = 6}, steps);
    RenderedFrames frames({.seed = 7}, steps);
    const FrameStack sound = frames.stack();
    EXPECT_FALSE(judge_first_frame(sound, before.stack(), frames.noise())) << steps;
    frames.frames[0] = before.frames.back();
    const auto found = judge_first_frame(
        frames.stack(), before.stack(), frames.noise(), {.has_other_check = true});
    ASSERT_TRUE(found) << steps;
    EXPECT_NE(found->finding.find("frame 0 shows the last frame of pattern"), std::string::npos);
    EXPECT_EQ(found->left_out.size(), steps == 3 ? 0U : 1U) << steps;
    EXPECT_EQ(found->action, steps == 3 ? FrameAction::LeaveOutView : FrameAction::LeaveOutFrames);
  }
}

TEST(JudgeFirstFrame, TakesTwoBlackFramesForNone) {
  RenderedFrames before({.period_px = 50.0, .seed = 6}, 4);
  RenderedFrames frames({.seed = 7}, 4);
  before.frames.back().assign(before.frames.back().size(), 6.0);
  frames.frames.front() = before.frames.back();
  EXPECT_FALSE(judge_first_frame(frames.stack(), before.stack(), frames.noise()));
}

}  // namespace
}  // namespace frangia
