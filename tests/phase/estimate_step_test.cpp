#include "frangia/phase/algorithm/estimate_step.h"

#include <cmath>

#include <gtest/gtest.h>

#include "frangia/core/angles.h"

#include "support/display_fringes.h"
#include "support/synthetic_fringes.h"

namespace frangia {
namespace {

using testing::equal_shifts;
using testing::quarter_steps;
using testing::render_frames;
using testing::Scene;

double steeply_aslant(int x, int y) {
  return 0.09 * x + 0.31 * y;
}

TEST(EstimateStep, RecoversTheStepWithinItsSigma) {
  for (const double error : {-0.05, 0.0, 0.05}) {
    const Scene scene{
        .height = 200, .modulation_counts = 9000.0, .noise_counts = 300.0, .step_error = error};
    const StepEstimate step = estimate_step(render_frames(scene, quarter_steps(), steeply_aslant));
    ASSERT_TRUE(step.found);
    EXPECT_NEAR(step.gain_error(), error, 4.0 * step.sigma_rad / step.nominal_rad);
    EXPECT_LT(deg_from_rad(step.sigma_rad), 0.022);
    EXPECT_NEAR(step.residual_counts2, 300.0 * 300.0, 0.02 * 300.0 * 300.0);
  }
}

TEST(EstimateStep, AcceptsMoreFramesDescendingStepsAndStepsBeyond180Degrees) {
  for (const double nominal : {kTwoPi / 5.0, -0.5 * kPi, 1.5 * kPi}) {
    Pattern pattern = quarter_steps();
    pattern.shifts_rad = equal_shifts(6, nominal);
    const Scene scene{.height = 100, .noise_counts = 100.0, .step_error = 0.03};
    const StepEstimate step = estimate_step(render_frames(scene, pattern, steeply_aslant));
    ASSERT_TRUE(step.found) << nominal;
    EXPECT_NEAR(step.gain_error(), 0.03, 1e-3) << nominal;
  }
}

/// Frames of a display with a second harmonic, 30 degrees apart.
FrameStack harmonic_frames(int frames, double harmonic, double step_error = 0.0) {
  std::vector<double> made = equal_shifts(frames, kPi / 6.0 * (1.0 + step_error));
  testing::DisplayScene scene{.peak_counts = 130.0};
  scene.waveform = [=](double phase) {
    return std::cos(phase) + harmonic * std::cos(2.0 * phase + 0.4);
  };
  FrameStack stack = display_frames(scene, made);
  stack.pattern.shifts_rad = equal_shifts(frames, kPi / 6.0);
  return stack;
}

TEST(EstimateStep, DoesNotTakeASecondHarmonicForAStepError) {
  for (const int frames : {4, 5, 6, 9, 12}) {
    const StepEstimate step = estimate_step(harmonic_frames(frames, 0.26));
    EXPECT_NEAR(step.step_rad, step.nominal_rad, 4.0 * step.sigma_rad) << frames;
    EXPECT_LT(std::abs(step.gain_error()), 0.005) << frames;
    EXPECT_EQ(step.jitter_rad, 0.0) << frames;
  }
}

TEST(EstimateStep, FindsAStepErrorInSpiteOfASecondHarmonic) {
  const StepEstimate step = estimate_step(harmonic_frames(12, 0.26, 0.03));
  ASSERT_TRUE(step.found);
  EXPECT_NEAR(step.gain_error(), 0.03, 0.002);
}

TEST(EstimateStep, FindsNothingWithoutFringesEqualStepsOrEnoughFrames) {
  const Scene dark{.height = 100, .modulation_counts = 0.0, .noise_counts = 100.0};
  EXPECT_FALSE(estimate_step(render_frames(dark, quarter_steps(), steeply_aslant)).found);
  Pattern uneven = quarter_steps();
  uneven.shifts_rad = {0.0, 1.0, 2.5, 4.0};
  EXPECT_FALSE(estimate_step(render_frames({}, uneven, steeply_aslant)).found);
  uneven.shifts_rad = equal_shifts(3, 0.5 * kPi);
  EXPECT_FALSE(estimate_step(render_frames({}, uneven, steeply_aslant)).found);
  const Scene white{.mean_counts = 1e6};
  EXPECT_FALSE(estimate_step(render_frames(white, quarter_steps(), steeply_aslant)).found);
}

}  // namespace
}  // namespace frangia
