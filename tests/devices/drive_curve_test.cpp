#include "frangia/devices/drive_curve.h"

#include <gtest/gtest.h>

#include "frangia/core/error.h"

namespace frangia {
namespace {

TEST(DriveCurve, VoltsAndPhaseAreInverse) {
  const DriveCurve curve({0.0, 2.0, 5.0}, {1.0, 2.0, 3.0});
  for (const double phase : {0.0, 0.7, 2.0, 4.9, 5.0})
    EXPECT_NEAR(curve.phase_at(curve.volts_at(phase)), phase, 1e-12);
  EXPECT_NEAR(curve.volts_at(3.5), 2.5, 1e-12);
}

TEST(DriveCurve, PhaseOutsideOfTheCurveIsRefused) {
  const DriveCurve curve({0.0, 1.0}, {0.0, 1.0});
  EXPECT_THROW(static_cast<void>(curve.volts_at(1.1)), Error);
  EXPECT_THROW(static_cast<void>(curve.volts_at(-0.1)), Error);
}

TEST(DriveCurve, PointsThatDoNotRiseAreRefused) {
  EXPECT_THROW(DriveCurve({0.0, 1.0}, {1.0, 1.0}), Error);
  EXPECT_THROW(DriveCurve({0.0}, {1.0}), Error);
}

}  // namespace
}  // namespace frangia
