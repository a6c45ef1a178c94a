// Views whose points are noisier than those of the others.
#include <cstddef>

#include <gtest/gtest.h>

#include "frangia/core/angles.h"

#include "support/pose_faults.h"

namespace frangia {
namespace {

/// The last view of the bracket shows its walls at a grazing angle: its points are noisy, and those
/// that do not tell the turn are many.
TEST(NoisyView, IsNotHeldByThePriorOfItsAngle) {
  testing::FaultyScan scan(8);
  const double without_mm = testing::registered(scan, testing::bracket()).error_mm;
  for (std::size_t view = 4; view < scan.views.size(); ++view)
    scan.views[view].angle_rad -= 0.01;  // a step is lost, within three deviations of the prior
  const testing::Registered out = testing::registered(scan, testing::bracket());
  for (std::size_t view = 0; view < scan.views.size(); ++view) {
    EXPECT_NEAR(
        deg_from_rad(out.report.angles_rad[view]), deg_from_rad(scan.views[view].angle_rad), 0.03)
        << view;
  }
  EXPECT_LT(out.error_mm, 2.0 * without_mm);
  EXPECT_LT(out.error.share_beyond, 0.05);
}

}  // namespace
}  // namespace frangia
