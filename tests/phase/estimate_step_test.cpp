#include "frangia/phase/estimate_step.h"

#include <cmath>

#include <gtest/gtest.h>

#include "frangia/core/angles.h"

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
