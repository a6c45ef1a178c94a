#include "frangia/phase/wrap/fill_enclosed.h"

#include <array>
#include <cmath>

#include <gtest/gtest.h>

#include "frangia/core/missing.h"

namespace frangia {
namespace {

double bowl(int x, int y) {
  return 0.2 * x - 0.1 * y + 0.001 * x * y;
}

AbsolutePhase measured(int width, int height) {
  AbsolutePhase phase{.pattern = {},
                      .phase_rad = Image<float>(width, height),
                      .sigma_rad = Image<float>(width, height, 0.02F),
                      .status = Image<PixelStatus>(width, height, PixelStatus::Measured)};
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x)
      phase.phase_rad(x, y) = static_cast<float>(bowl(x, y));
  }
  return phase;
}

using Corner = std::array<int, 2>;  ///< x and y, in pixels

/// Removes the pixels from one corner up to, but excluding, the other.
void punch(AbsolutePhase& phase, Corner from, Corner to, PixelStatus status) {
  for (int y = from[1]; y < to[1]; ++y) {
    for (int x = from[0]; x < to[0]; ++x) {
      phase.phase_rad(x, y) = kMissing;
      phase.sigma_rad(x, y) = kMissing;
      phase.status(x, y) = status;
    }
  }
}

TEST(FillEnclosed, InterpolatesASaturatedHighlightAndMarksIt) {
  AbsolutePhase phase = measured(40, 30);
  punch(phase, {10, 10}, {17, 16}, PixelStatus::Saturated);
  EXPECT_EQ(fill_enclosed(phase), 42U);
  for (int y = 10; y < 16; ++y) {
    for (int x = 10; x < 17; ++x) {
      EXPECT_NEAR(phase.phase_rad(x, y), bowl(x, y), 0.01);
      EXPECT_GE(phase.sigma_rad(x, y), 0.02F);
      EXPECT_EQ(phase.status(x, y), PixelStatus::Filled);
    }
  }
}

TEST(FillEnclosed, KeepsALargeUnmodulatedHole) {
  AbsolutePhase phase = measured(40, 30);
  punch(phase, {10, 10}, {16, 16}, PixelStatus::Unmodulated);
  EXPECT_EQ(fill_enclosed(phase), 0U);
}

TEST(FillEnclosed, KeepsAHoleThatReachesTheBorder) {
  AbsolutePhase phase = measured(40, 30);
  punch(phase, {0, 10}, {5, 14}, PixelStatus::Saturated);
  EXPECT_EQ(fill_enclosed(phase), 0U);
}

TEST(FillEnclosed, KeepsALargePatchWhicheverOfItsTopsTheSearchStartsAt) {
  AbsolutePhase phase = measured(60, 60);
  for (int prong = 10; prong < 50; prong += 4)  // a comb: each prong is a start of its own
    punch(phase, {prong, 10}, {prong + 2, 20}, PixelStatus::Saturated);
  punch(phase, {10, 20}, {48, 24}, PixelStatus::Saturated);
  punch(phase, {54, 10}, {56, 12}, PixelStatus::Saturated);
  EXPECT_EQ(fill_enclosed(phase), 4U);
}

TEST(FillEnclosed, DoesNotBridgeADepthStep) {
  AbsolutePhase phase = measured(40, 30);
  punch(phase, {18, 10}, {22, 14}, PixelStatus::Residue);
  for (int y = 0; y < 30; ++y) {
    for (int x = 20; x < 40; ++x)
      phase.phase_rad(x, y) += 6.0F;
  }
  EXPECT_EQ(fill_enclosed(phase), 0U);
}

}  // namespace
}  // namespace frangia
