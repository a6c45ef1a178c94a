#include "frangia/phase/waveform/assess_frames.h"

#include <cmath>
#include <ctime>
#include <limits>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "frangia/phase/wrap/wrap_phase.h"

#include "support/display_fringes.h"
#include "support/synthetic_fringes.h"

namespace frangia {
namespace {

using testing::display_frames;
using testing::equal_shifts;
using testing::render_frames;
using testing::Scene;
using testing::tilted_plane;

const NoiseModel kAssessedNoise{.floor_counts2 = 200.0 * 200.0};

struct AssessedFringes {
  FrameStack stack;
  FittedAlgorithm fitted;
  WrappedPhase map;

  explicit AssessedFringes(int frames, int height = 100) {
    Pattern pattern{.name = "fringe", .period_px = 20.0};
    pattern.shifts_rad = equal_shifts(frames, kTwoPi / frames);
    stack = render_frames({.height = height, .modulation_counts = 9000.0, .noise_counts = 200.0},
                          pattern,
                          tilted_plane);
    fitted = fit_algorithm("auto", stack, kAssessedNoise);
    map = wrap_phase(stack, fitted.algorithm, kAssessedNoise);
  }
  [[nodiscard]] FrameAssessment assess() const {
    return assess_frames(stack, fitted, map, kAssessedNoise);
  }
  /// Shortest processor time of three assessments, in seconds.
  [[nodiscard]] double seconds() const {
    double shortest_s = std::numeric_limits<double>::infinity();
    for (int run = 0; run < 3; ++run) {
      const std::clock_t start = std::clock();
      EXPECT_FALSE(assess().exceeds_noise);
      const double spent_s = static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
      shortest_s = std::min(shortest_s, spent_s);
    }
    return shortest_s;
  }
};

TEST(AssessFrames, FindsTheResidualOfNoiseToBeOne) {
  for (const int frames : {4, 5, 9, 64})
    EXPECT_NEAR(AssessedFringes(frames).assess().residual_ratio, 1.0, 0.03) << frames;
}

TEST(AssessFrames, TheResidualOfFourQuarterStepsIsTheirAlternatingSum) {
  const AssessedFringes fringes(4, 20);
  double sum = 0.0;
  const auto counts = [&](std::size_t frame, std::size_t pixel) {
    return std::visit([&](const auto& image) { return static_cast<double>(image.pixels()[pixel]); },
                      fringes.stack.frames[frame]);
  };
  const std::size_t pixels = fringes.map.status.pixels().size();
  for (std::size_t i = 0; i < pixels; ++i) {
    const double residual = counts(0, i) - counts(1, i) + counts(2, i) - counts(3, i);
    sum += std::min(0.25 * residual * residual / kAssessedNoise.floor_counts2, 25.0);
  }
  EXPECT_NEAR(fringes.assess().residual_ratio, sum / static_cast<double>(pixels), 1e-6);
}

TEST(AssessFrames, TakesTimeLinearInTheFrames) {
  // 8 times the frames; 64 times the time, as before, would be their square.
  EXPECT_LT(AssessedFringes(256, 10).seconds(), 24.0 * AssessedFringes(32, 10).seconds());
}

FrameAssessment assess(const testing::DisplayScene& scene, int frames) {
  const FrameStack stack = display_frames(scene, equal_shifts(frames, kTwoPi / frames));
  const NoiseModel noise{.floor_counts2 = scene.noise_counts * scene.noise_counts + 1.0 / 12.0};
  const FittedAlgorithm fitted = fit_algorithm("auto", stack, noise);
  return assess_frames(stack, fitted, wrap_phase(stack, fitted.algorithm, noise), noise);
}

bool contains(const std::string& text, const std::string& words) {
  return text.find(words) != std::string::npos;
}

TEST(AssessFrames, NamesTheHarmonicOfAGammaAndNotMotion) {
  for (const int frames : {3, 4, 5, 6}) {
    const FrameAssessment found = assess({.gamma = 1.8}, frames);
    EXPECT_FALSE(found.exceeds_noise) << frames;
    EXPECT_EQ(found.harmonic, 2);
    EXPECT_NEAR(found.harmonic_share, 0.21, 0.01);
    EXPECT_TRUE(contains(describe(found), "a second harmonic of 2")) << describe(found);
  }
  const FrameAssessment three = assess({.gamma = 1.8}, 3);
  EXPECT_NEAR(three.harmonic_error_rad, 0.149, 0.01);
  EXPECT_TRUE(needs_attention(three));
  EXPECT_TRUE(contains(describe(three), "give it as `undo_response`")) << describe(three);
  EXPECT_FALSE(needs_attention(assess({.gamma = 1.8, .dark_counts = 40.0}, 6)));
}

TEST(AssessFrames, NamesFlickerAndNotMotion) {
  for (const int frames : {5, 6, 12}) {
    testing::DisplayScene scene;
    for (int k = 0; k < frames; ++k)
      scene.gains.push_back(0.03 * std::sin(2.3 * k * k + 1.0));
    const FrameAssessment found = assess(scene, frames);
    EXPECT_GT(found.residual_ratio, 1.6) << frames;
    EXPECT_FALSE(found.exceeds_noise) << frames;
    EXPECT_TRUE(contains(describe(found), "the light flickered by")) << describe(found);
  }
}

TEST(AssessFrames, WarnsOfFlickerThatFourFramesDoNotDetermine) {
  const FrameAssessment found = assess({.gains = {0.03, -0.02, 0.0, 0.02}}, 4);
  EXPECT_TRUE(needs_attention(found));
  EXPECT_TRUE(contains(describe(found), "4 frames do not determine it")) << describe(found);
}

TEST(AssessFrames, NamesAContrastAboveThatOfAnySine) {
  FrameAssessment assessment{.pattern = "p20", .algorithm = "least-squares", .contrast = 1.3};
  EXPECT_TRUE(needs_attention(assessment));
  EXPECT_TRUE(contains(describe(assessment), "a contrast of 1.30 is more than"))
      << describe(assessment);
  assessment.contrast = 0.95;
  EXPECT_FALSE(needs_attention(assessment));
}

TEST(AssessFrames, SaysThatFramesDifferBeyondTheirNoise) {
  testing::DisplayScene scene;
  std::vector<double> made = equal_shifts(6, kTwoPi / 6.0);
  made[2] += 0.2;
  FrameStack stack = display_frames(scene, made);
  stack.pattern.shifts_rad = equal_shifts(6, kTwoPi / 6.0);
  const NoiseModel noise{.floor_counts2 = 1.1};
  const FittedAlgorithm fitted = fit_algorithm("auto", stack, noise);
  const FrameAssessment found =
      assess_frames(stack, fitted, wrap_phase(stack, fitted.algorithm, noise), noise);
  EXPECT_TRUE(found.exceeds_noise);
  EXPECT_TRUE(contains(describe(found), "frames differ beyond their noise"));
}

}  // namespace
}  // namespace frangia
