// Frames of closed formulas that contradict each other in a part of the image, or of which one was
// taken elsewhere: what they show is named, and no frame that is as bright as the others is black.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <functional>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "frangia/decode/explain/explain_frames.h"
#include "frangia/decode/explain/judge_frames.h"

#include "support/rendered_frames.h"

namespace frangia {
namespace {

using testing::RenderedFrames;
using testing::RenderedScene;

/// One fringe over three times the image, as the coarsest of several patterns: all of the part is
/// in the dark of one frame.
constexpr double kCoarse_px = 480.0;

/// What a hand shows in a rectangle that is an eighth of the lit part of the image.
void cover(RenderedFrames& frames, std::size_t frame) {
  for (std::size_t i = 0; i < frames.frames[frame].size(); ++i) {
    const std::size_t x = i % 160;
    const std::size_t y = i / 160;
    if (x >= 75 && x < 105 && y >= 30 && y < 90)
      frames.frames[frame][i] = 70.0 + 10.0 * std::sin(0.2 * static_cast<double>(x + y));
  }
}

/// Displaces a frame by a pixel, blurred as by a lens.
void displace(RenderedFrames& frames, std::size_t frame) {
  for (auto& light : frames.frames) {
    const std::vector<double> sharp = light;
    for (std::size_t i = 1; i + 1 < sharp.size(); ++i)
      light[i] = 0.25 * sharp[i - 1] + 0.5 * sharp[i] + 0.25 * sharp[i + 1];
  }
  std::vector<double>& light = frames.frames[frame];
  for (std::size_t i = light.size() - 1; i > 0; --i)
    light[i] = light[i - 1];
}

/// Fringes of another surface.
void show_another_view(RenderedFrames& frames, std::size_t frame) {
  for (std::size_t i = 0; i < frames.frames[frame].size(); ++i) {
    const auto x = static_cast<double>(i % 160);
    const auto y = static_cast<double>(i / 160);
    frames.frames[frame][i] =
        90.0 + 60.0 * std::sin(0.21 * x + 2.0 * std::sin(0.06 * y)) * std::cos(0.02 * x - 0.05 * y);
  }
}

void show_white(RenderedFrames& frames, std::size_t frame) {
  std::fill(frames.frames[frame].begin(), frames.frames[frame].end(), 400.0);
}

using FaultOfFrame = void (*)(RenderedFrames&, std::size_t);

/// Frames of a pattern, and finer ones of the same view that are as described.
struct TwoPatterns {
  FrameStack faulty;
  FrameStack sound;
  NoiseModel noise;

  TwoPatterns(RenderedScene scene, int steps, FaultOfFrame fault, std::size_t frame) {
    RenderedFrames frames(scene, steps);
    fault(frames, frame);
    faulty = frames.stack();
    noise = frames.noise();
    scene.period_px = 18.0;
    RenderedFrames fine(scene, steps);
    sound = fine.stack();
    sound.pattern.name = "fine";
  }
  [[nodiscard]] FrameExplanation alone() const { return explain_frames(faulty, noise); }
  [[nodiscard]] FrameExplanation beside_sound() const {
    const std::array references{&sound};
    return explain_frames(faulty, noise, references);
  }
  [[nodiscard]] FrameVerdict verdict() const {
    const std::array references{&sound};
    return judge_frames(faulty, noise, {.has_other_check = true, .references = references});
  }
};

std::string text_of(const FrameExplanation& found) {
  return describe(found.explanation);
}

TEST(CoveredFrames, NameThePartOfTheImage) {
  for (const int steps : {4, 6}) {
    for (const double period_px : {18.0, 60.0}) {
      const TwoPatterns frames({.period_px = period_px, .seed = 41}, steps, cover, 1);
      const FrameExplanation found = frames.alone();
      EXPECT_TRUE(found.has_fault()) << steps << " " << text_of(found);
      EXPECT_EQ(name_of(found.best.cause), "covered") << steps << " " << text_of(found);
      EXPECT_NEAR(found.best.part, 30.0 * 60.0 / (0.75 * 160.0 * 120.0), 0.05);
      // The residual of four frames does not tell which of them it is.
      EXPECT_EQ(found.best.frames,
                steps == 4 ? std::vector<std::size_t>{} : std::vector<std::size_t>{1})
          << text_of(found);
    }
  }
}

TEST(CoveredFrames, NameTheFrameThatOtherPatternsContradict) {
  for (const double period_px : {60.0, kCoarse_px}) {
    const TwoPatterns frames({.period_px = period_px, .seed = 42}, 4, cover, 1);
    const FrameExplanation found = frames.beside_sound();
    EXPECT_EQ(name_of(found.best.cause), "covered") << period_px << " " << text_of(found);
    EXPECT_EQ(found.best.frames, std::vector<std::size_t>{1}) << text_of(found);
    const FrameVerdict verdict = frames.verdict();
    EXPECT_EQ(verdict.action, FrameAction::LeaveOutFrames) << verdict.finding;
    EXPECT_EQ(verdict.left_out, std::vector<std::size_t>{1});
  }
}

TEST(CoveredFrames, KeepTheViewWhereNoFrameIsNamed) {
  const TwoPatterns frames({.seed = 43}, 4, cover, 1);
  const FrameVerdict verdict = judge_frames(frames.faulty, frames.noise);
  EXPECT_EQ(verdict.action, FrameAction::Use) << verdict.finding;
  EXPECT_NE(verdict.finding, "");
}

TEST(DisplacedFrames, AreNamedWithTheirDisplacement) {
  for (const int steps : {5, 6}) {
    const TwoPatterns frames({.seed = 44}, steps, displace, 1);
    const FrameExplanation found = frames.alone();
    EXPECT_TRUE(found.has_fault()) << steps << " " << text_of(found);
    EXPECT_EQ(name_of(found.best.cause), "displaced") << steps << " " << text_of(found);
    EXPECT_EQ(found.best.frames, std::vector<std::size_t>{1}) << text_of(found);
    EXPECT_NEAR(found.best.displacement_px, 1.0, 0.25);
    EXPECT_EQ(frames.verdict().left_out, std::vector<std::size_t>{1});
  }
}

TEST(FramesOfAnotherView, AreNamedWhereOtherPatternsContradictThem) {
  for (const double period_px : {60.0, kCoarse_px}) {
    const TwoPatterns frames({.period_px = period_px, .seed = 45}, 4, show_another_view, 2);
    const FrameExplanation found = frames.beside_sound();
    EXPECT_TRUE(found.has_fault()) << period_px << " " << text_of(found);
    EXPECT_EQ(name_of(found.best.cause), "lost") << period_px << " " << text_of(found);
    EXPECT_EQ(found.best.frames, std::vector<std::size_t>{2}) << text_of(found);
  }
}

TEST(FramesOfAnotherView, AreLeftOutWithoutAWordAboutOthers) {
  for (const std::size_t frame : {1U, 2U}) {
    const TwoPatterns frames({.period_px = kCoarse_px, .seed = 48}, 4, show_another_view, frame);
    const FrameVerdict verdict = frames.verdict();
    EXPECT_EQ(verdict.action, FrameAction::LeaveOutFrames) << verdict.finding;
    EXPECT_EQ(verdict.left_out, std::vector<std::size_t>{frame}) << verdict.finding;
  }
}

// Two frames have no phase that other patterns could refute.
TEST(WhiteFrames, OfThreeAreNamedBesideOtherPatterns) {
  const TwoPatterns frames({.seed = 49}, 3, show_white, 1);
  const FrameVerdict verdict = frames.verdict();
  EXPECT_EQ(verdict.action, FrameAction::LeaveOutView) << verdict.finding;
  EXPECT_NE(verdict.finding.find("frame 1 is white"), std::string::npos) << verdict.finding;
}

TEST(BlackFrames, AreNoFramesInTheDarkOfACoarseFringeThatFinerOnesContradict) {
  for (const FaultOfFrame fault : {cover, displace, show_another_view}) {
    for (const std::size_t frame : {1U, 2U}) {
      const TwoPatterns frames({.period_px = kCoarse_px, .seed = 47}, 4, fault, frame);
      const FrameExplanation found = frames.beside_sound();
      const bool blames_another = found.has_fault() && !found.best.frames.empty() &&
                                  found.best.frames != std::vector<std::size_t>{frame};
      EXPECT_FALSE(blames_another) << frame << " " << text_of(found);
    }
  }
}

}  // namespace
}  // namespace frangia
