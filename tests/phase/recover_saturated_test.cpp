#include <cmath>

#include <gtest/gtest.h>

#include "frangia/core/error.h"
#include "frangia/phase/algorithm/phase_algorithm.h"
#include "frangia/phase/wrap/merge_exposures.h"
#include "frangia/phase/wrap/wrap_phase.h"

#include "support/synthetic_fringes.h"

namespace frangia {
namespace {

using testing::quarter_steps;
using testing::render_frames;

double even_ramp(int x, int /*y*/) {
  return 0.05 * x;
}

TEST(RecoverSaturated, RecoversOneSaturatedFrameFromTheOtherThree) {
  // Counts saturate at 45000 of 50000.
  FrameStack stack = render_frames({.white_level = 45000}, quarter_steps(), even_ramp);
  const FrameStack cut = stack;
  const PhaseAlgorithm algorithm = make_algorithm("4-step", stack.pattern.shifts_rad);
  const WrappedPhase before = wrap_phase(cut, algorithm, {});
  EXPECT_GT(recover_saturated(stack), 500U);
  const WrappedPhase after = wrap_phase(stack, algorithm, {});
  for (int x = 0; x < 640; ++x) {
    EXPECT_EQ(after.status(x, 1), PixelStatus::Measured);
    EXPECT_NEAR(wrap_rad(after.phase_rad(x, 1) - even_ramp(x, 1)), 0.0, 2e-4);
  }
  EXPECT_GT(
      std::count(
          before.status.pixels().begin(), before.status.pixels().end(), PixelStatus::Saturated),
      500);
}

TEST(RecoverSaturated, LeavesPixelsWithTwoSaturatedFramesSaturated) {
  FrameStack stack = render_frames({.white_level = 35000}, quarter_steps(), [](int, int) {
    return -0.25 * kPi;  // frames 1 and 2 are equally bright
  });
  EXPECT_EQ(recover_saturated(stack), 0U);
  const auto map = wrap_phase(stack, make_algorithm("4-step", stack.pattern.shifts_rad), {});
  EXPECT_EQ(map.status(3, 1), PixelStatus::Saturated);
}

TEST(RecoverSaturated, RefusesOtherShiftsThanFourQuarterSteps) {
  Pattern three = quarter_steps();
  three.shifts_rad = testing::equal_shifts(3, 0.5 * kPi);
  FrameStack stack = render_frames({}, three, even_ramp);
  EXPECT_THROW(recover_saturated(stack), Error);
}

}  // namespace
}  // namespace frangia
