#include "frangia/rig/fringe_waveform.h"

#include <cmath>

#include <gtest/gtest.h>

#include "frangia/core/angles.h"
#include "frangia/rig/rig.h"

namespace frangia {
namespace {

TEST(FringeWaveform, IsTheSumOfItsHarmonics) {
  const FringeWaveform waveform{.harmonics = {{0.2, 0.1}, {0.0, -0.05}}};
  for (const double phase : {-2.0, 0.0, 0.7, 3.0}) {
    EXPECT_NEAR(waveform.light_at(phase),
                std::cos(phase) + 0.2 * std::cos(2 * phase) - 0.1 * std::sin(2 * phase) +
                    0.05 * std::sin(3 * phase),
                1e-12);
  }
  EXPECT_NEAR(waveform.amplitude(2), std::hypot(0.2, 0.1), 1e-12);
  EXPECT_NEAR(waveform.amplitude(3), 0.05, 1e-12);
  for (const int other : {-1, 0, 1, 4, 5})
    EXPECT_EQ(waveform.amplitude(other), 0.0);
}

TEST(FindWaveform, TakesTheNearestPeriodByRatioOfTheSameDirection) {
  const auto of = [](double period_px, FringeDirection direction = FringeDirection::Vertical) {
    return FringeWaveform{.period_px = period_px, .direction = direction, .harmonics = {}};
  };
  const std::vector<FringeWaveform> known = {
      of(12.0, FringeDirection::Horizontal), of(10.0), of(40.0), of(40.0)};
  EXPECT_EQ(find_waveform(known, {.period_px = 19.0}), &known[1]);
  EXPECT_EQ(find_waveform(known, {.period_px = 21.0}), &known[2]) << "20 is as near to both";
  EXPECT_EQ(find_waveform(known, {.period_px = 1.0}), &known[1]);
  EXPECT_EQ(find_waveform(known, {.direction = FringeDirection::Horizontal, .period_px = 40.0}),
            &known[0]);
  EXPECT_EQ(
      find_waveform({known[1]}, {.direction = FringeDirection::Horizontal, .period_px = 40.0}),
      nullptr);
  EXPECT_EQ(find_waveform(known, {.fringes_per_degree = 1.0}), &known[1]) << "nothing to compare";
  const std::vector<FringeWaveform> any = {of(8.0), of(0.0)};
  EXPECT_EQ(find_waveform(any, {.period_px = 16.0}), &any[1]) << "0 is any period";
}

TEST(PhaseRangeOfField, CoversWholePixels) {
  Projector projector;
  projector.model = PinholeModel{.width_px = 640, .height_px = 480, .focal_px = {900.0, 900.0}};
  const PhaseRange columns = phase_range({.period_px = 40.0}, projector);
  EXPECT_NEAR(columns.min_rad, -kTwoPi * 0.5 / 40.0, 1e-12);
  EXPECT_NEAR(columns.max_rad, kTwoPi * 639.5 / 40.0, 1e-12);
  EXPECT_NEAR(columns.width_rad(), kTwoPi * 16.0, 1e-12);
  EXPECT_NEAR(columns.center_rad(), kTwoPi * 319.5 / 40.0, 1e-12);
  const PhaseRange rows =
      phase_range({.direction = FringeDirection::Horizontal, .period_px = 40.0}, projector);
  EXPECT_NEAR(rows.max_rad, kTwoPi * 479.5 / 40.0, 1e-12);
  EXPECT_TRUE(is_absolute({.period_px = 640.0}, projector));
  EXPECT_FALSE(is_absolute({.period_px = 639.9}, projector));
  EXPECT_FALSE(is_absolute({.kind = PatternKind::Line, .period_px = 640.0}, projector));
}

TEST(PhaseRangeOfField, IsThatOfTheAnglesDividedByTheScaleOfThePitch) {
  Projector projector;
  projector.model = AngularModel{.field_min_rad = rad_from_deg(-10.0),
                                 .field_max_rad = rad_from_deg(14.0),
                                 .pitch_scale = 1.25};
  const PhaseRange range = phase_range({.fringes_per_degree = 2.0}, projector);
  EXPECT_NEAR(range.min_rad, -kTwoPi * 20.0 / 1.25, 1e-9);
  EXPECT_NEAR(range.max_rad, kTwoPi * 28.0 / 1.25, 1e-9);
}

/// A camera and a projector whose axes cross at a point, both turned by hand.
TEST(CrossingOfAxes, IsTheMiddleOfTheShortestLineBetweenTheAxes) {
  Rig rig;
  rig.reference().model = {.width_px = 101,
                           .height_px = 81,
                           .focal_px = {200.0, 200.0},
                           .principal_point_px = {50.0, 40.0}};
  const Eigen::Vector3d crossing(0.0, 0.0, 500.0);
  rig.projector.position_mm = {-300.0, 40.0, 100.0};
  const Eigen::Vector3d forward = (crossing - rig.projector.position_mm).normalized();
  const Eigen::Vector3d right = Eigen::Vector3d::UnitY().cross(forward).normalized();
  rig.projector.rotation << right.transpose(), forward.cross(right).transpose(),
      forward.transpose();
  rig.projector.model = AngularModel{rad_from_deg(-10.0), rad_from_deg(10.0)};
  EXPECT_LT((crossing_of_axes(rig) - crossing).norm(), 1e-9);
  PinholeModel pinhole{.width_px = 641,
                       .height_px = 481,
                       .focal_px = {900.0, 900.0},
                       .principal_point_px = {320.0, 240.0}};
  rig.projector.model = pinhole;
  EXPECT_LT((crossing_of_axes(rig) - crossing).norm(), 1e-9);
  // Axes that miss each other by 8 mm.
  const Eigen::Vector3d apart = forward.cross(Eigen::Vector3d::UnitZ()).normalized();
  rig.projector.position_mm += 8.0 * apart;
  EXPECT_LT((crossing_of_axes(rig) - (crossing + 4.0 * apart)).norm(), 1e-9);
  // The axis is the ray through the middle of the image.
  pinhole.principal_point_px = {320.0 + 90.0, 240.0};
  rig.projector.model = pinhole;
  EXPECT_GT((crossing_of_axes(rig) - (crossing + 4.0 * apart)).norm(), 20.0);
  rig.reference().model.principal_point_px = {50.0 + 20.0, 40.0};
  EXPECT_NEAR(crossing_of_axes(rig).x() / crossing_of_axes(rig).z(), -0.1, 0.02);
}

}  // namespace
}  // namespace frangia
