// A pattern that the part covers in less than a fringe, one frame of which is lost; frames of
// closed formulas.
#include "frangia/decode/explain/judge_coarse_frames.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <optional>
#include <random>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "frangia/core/angles.h"

namespace frangia {
namespace {

constexpr int kPartWidth_px = 120;
constexpr int kPartHeight_px = 90;

/// What is not as it should be with the projector and its surroundings.
struct CoarseScene {
  int steps = 3;
  double ambient = 0.0;
  double gamma = 1.0;
  double flicker = 0.0;
  double blur_of_fine = 1.0;  ///< modulation of the fine pattern over that of the coarse one
};

/// Frames of a curved part that covers a fifth of a fringe of 1280 px.
FrameStack part_frames(double period_px, const CoarseScene& scene) {
  std::mt19937 generator(static_cast<unsigned>(period_px) + 5U);
  std::normal_distribution<double> normal;
  FrameStack out;
  out.pattern = {.name = std::to_string(static_cast<int>(period_px)), .period_px = period_px};
  out.pattern.shifts_rad.clear();
  const double contrast = 0.9 * (period_px < 1000.0 ? scene.blur_of_fine : 1.0);
  for (int k = 0; k < scene.steps; ++k) {
    out.pattern.shifts_rad.push_back(kTwoPi * k / scene.steps);
    const double gain = 1.0 + scene.flicker * normal(generator);
    Image<std::uint8_t> image(kPartWidth_px, kPartHeight_px);
    for (int y = 0; y < kPartHeight_px; ++y) {
      for (int x = 0; x < kPartWidth_px; ++x) {
        const double column = 500.0 + 2.1 * x + 9.0 * std::sin(0.05 * x + 0.08 * y);
        const double phase = kTwoPi * column / period_px + out.pattern.shifts_rad.back();
        const double albedo = 0.6 + 0.3 * std::sin(0.1 * x - 0.06 * y);
        const double level = 0.5 + 0.5 * contrast * std::cos(phase);
        const double light = 200.0 * albedo * (std::pow(level, scene.gamma) * gain + scene.ambient);
        image(x, y) =
            static_cast<std::uint8_t>(std::lround(std::max(0.0, light + 1.0 * normal(generator))));
      }
    }
    out.frames.emplace_back(std::move(image));
  }
  return out;
}

std::optional<FrameVerdict> judged(const CoarseScene& scene,
                                   const FrameStack& coarse,
                                   bool may_leave_out = true) {
  const FrameStack fine = part_frames(160.0, scene);
  const std::array references{&fine};
  return judge_coarse_frames(coarse,
                             NoiseModel{.floor_counts2 = 1.1},
                             {.may_leave_out = may_leave_out, .references = references});
}

void fill(FrameStack& stack, std::size_t frame, double counts) {
  for (std::uint8_t& one : std::get<Image<std::uint8_t>>(stack.frames[frame]).pixels())
    one = static_cast<std::uint8_t>(std::lround(counts));
}

TEST(JudgeCoarseFrames, NamesABlackFrameInTheLightOfARoom) {
  for (const int steps : {3, 4, 6}) {
    for (const double ambient : {0.0, 0.05, 0.15}) {
      const CoarseScene scene{.steps = steps, .ambient = ambient};
      FrameStack coarse = part_frames(1280.0, scene);
      fill(coarse, 2, 200.0 * 0.6 * ambient);
      const std::optional<FrameVerdict> found = judged(scene, coarse);
      ASSERT_TRUE(found) << steps << " " << ambient;
      EXPECT_EQ(found->explanation.best.frames, std::vector<std::size_t>{2});
      EXPECT_NE(found->finding.find("frame 2 is black"), std::string::npos) << found->finding;
      EXPECT_EQ(found->action,
                steps == 3 ? FrameAction::LeaveOutView : FrameAction::LeaveOutFrames);
      EXPECT_EQ(judged(scene, coarse, false)->action, FrameAction::LeaveOutView);
    }
  }
}

TEST(JudgeCoarseFrames, NamesAFrameThatShowsAnother) {
  for (const int steps : {4, 6}) {
    const CoarseScene scene{.steps = steps};
    FrameStack coarse = part_frames(1280.0, scene);
    coarse.frames[1] = part_frames(160.0, scene).frames[0];
    const std::optional<FrameVerdict> found = judged(scene, coarse);
    ASSERT_TRUE(found) << steps;
    EXPECT_EQ(found->left_out, std::vector<std::size_t>{1}) << found->finding;
  }
}

TEST(JudgeCoarseFrames, BlamesNoSoundFrames) {
  for (const int steps : {3, 4, 6}) {
    for (const double gamma : {1.0, 1.6, 2.2}) {
      for (const double flicker : {0.0, 0.03}) {
        for (const double blur : {1.0, 0.8}) {
          const CoarseScene scene{steps, 0.1, gamma, flicker, blur};
          const auto found = judged(scene, part_frames(1280.0, scene));
          EXPECT_FALSE(found) << steps << " " << gamma << " " << flicker << " " << blur << ": "
                              << found->finding;
        }
      }
    }
  }
}

}  // namespace
}  // namespace frangia
