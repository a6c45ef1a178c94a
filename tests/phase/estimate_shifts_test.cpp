#include "frangia/phase/algorithm/estimate_shifts.h"

#include <algorithm>
#include <cmath>
#include <ctime>
#include <limits>

#include <gtest/gtest.h>

#include "frangia/core/angles.h"
#include "frangia/core/error.h"

#include "support/synthetic_fringes.h"

namespace frangia {
namespace {

using testing::equal_shifts;
using testing::quarter_steps;
using testing::render_frames;
using testing::Scene;
using testing::tilted_plane;

const Scene kScene{.height = 100, .modulation_counts = 9000.0, .noise_counts = 200.0};
const NoiseModel kStrongNoise{.floor_counts2 = 200.0 * 200.0};

TEST(EstimateShifts, FindsUnequalShiftsBetweenTheFrames) {
  Pattern made = quarter_steps();
  made.shifts_rad = {0.0, 1.1, 2.0, 3.4, 4.1, 5.6, 5.9};
  FrameStack stack = render_frames(kScene, made, tilted_plane);
  stack.pattern.shifts_rad = equal_shifts(7, 1.0);
  const ShiftEstimate found = estimate_shifts(stack, kStrongNoise);
  ASSERT_TRUE(found.found) << found.residual_counts2 << " of " << found.expected_counts2;
  for (std::size_t k = 1; k < 7; ++k)
    EXPECT_NEAR(found.shifts_rad[k] - found.shifts_rad[0], made.shifts_rad[k], 2e-3) << k;
}

TEST(EstimateShifts, RecoversShiftsOfAWrongGainWithoutAnOffset) {
  Pattern pattern = quarter_steps();
  pattern.shifts_rad = equal_shifts(8, 0.25 * kPi);
  Scene scene = kScene;
  scene.step_error = 0.05;
  const ShiftEstimate found =
      estimate_shifts(render_frames(scene, pattern, tilted_plane), kStrongNoise);
  ASSERT_TRUE(found.found);
  for (std::size_t k = 0; k < 8; ++k)
    EXPECT_NEAR(found.shifts_rad[k], 1.05 * pattern.shifts_rad[k], 2e-3) << k;
}

TEST(EstimateShifts, IsNotFoundWhenNoShiftsFitTheFrames) {
  Pattern pattern = quarter_steps();
  pattern.shifts_rad = equal_shifts(8, 0.25 * kPi);
  FrameStack stack = render_frames(kScene, pattern, tilted_plane);
  // Half of the image has moved in one frame.
  const FrameStack moved = render_frames(
      kScene, pattern, [](int x, int y) { return tilted_plane(x, y) + (x > 300 ? 0.5 : 0.0); });
  stack.frames[3] = moved.frames[3];
  const ShiftEstimate found = estimate_shifts(stack, kStrongNoise);
  EXPECT_FALSE(found.found);
  EXPECT_EQ(found.shifts_rad, pattern.shifts_rad);
  EXPECT_GT(found.residual_counts2, 1.5 * found.expected_counts2);
}

/// Shortest processor time of three runs, in seconds, to find the shifts of a number of frames.
double seconds_for(int frames) {
  Pattern pattern = quarter_steps();
  pattern.shifts_rad = equal_shifts(frames, kTwoPi / 9.0);
  Scene scene = kScene;
  scene.step_error = 0.02;
  scene.height = 32;
  const FrameStack stack = render_frames(scene, pattern, tilted_plane);
  double shortest_s = std::numeric_limits<double>::infinity();
  for (int run = 0; run < 3; ++run) {
    const std::clock_t start = std::clock();
    EXPECT_TRUE(estimate_shifts(stack, kStrongNoise).found) << frames;
    const double spent_s = static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
    shortest_s = std::min(shortest_s, spent_s);
  }
  return shortest_s;
}

TEST(EstimateShifts, TakesTheSquareOfTheFramesInTime) {
  // The square is 16 times the time; the fourth power, as before, would be 256 times.
  EXPECT_LT(seconds_for(160), 48.0 * seconds_for(40));
}

TEST(EstimateShifts, FindsTheShiftsOf360Frames) {
  Pattern pattern = quarter_steps();
  pattern.shifts_rad = equal_shifts(360, rad_from_deg(1.0));
  Scene scene = kScene;
  scene.height = 16;
  scene.step_error = 0.05;
  const ShiftEstimate found =
      estimate_shifts(render_frames(scene, pattern, tilted_plane), kStrongNoise);
  ASSERT_TRUE(found.found);
  for (std::size_t k = 0; k < 360; ++k)
    EXPECT_NEAR(found.shifts_rad[k], 1.05 * pattern.shifts_rad[k], 5e-3) << k;
}

TEST(EstimateShifts, NeedsSixFrames) {
  EXPECT_THROW(static_cast<void>(
                   estimate_shifts(render_frames({}, quarter_steps(), tilted_plane), kStrongNoise)),
               Error);
}

}  // namespace
}  // namespace frangia
