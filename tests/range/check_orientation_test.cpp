#include "frangia/range/check_orientation.h"

#include <cmath>

#include <gtest/gtest.h>

namespace frangia {
namespace {

constexpr double kTurn = 6.283185307179586;

/// A camera and a projector 200 mm to its right, both without distortion, turned to cross at 500
/// mm.
Rig crossed_rig() {
  Rig rig;
  rig.reference().model = {.width_px = 160,
                           .height_px = 120,
                           .focal_px = {300.0, 300.0},
                           .principal_point_px = {80.0, 60.0}};
  const double angle = std::atan2(200.0, 500.0);
  rig.projector.position_mm = {200.0, 0.0, 0.0};
  rig.projector.rotation << std::cos(angle), 0.0, std::sin(angle), 0.0, 1.0, 0.0, -std::sin(angle),
      0.0, std::cos(angle);
  rig.projector.model = PinholeModel{.width_px = 640,
                                     .height_px = 480,
                                     .focal_px = {1000.0, 1000.0},
                                     .principal_point_px = {320.0, 240.0}};
  return rig;
}

/// The phases of a bumpy surface, by the pinhole equations written out.
AbsolutePhase bumpy(const Rig& rig,
                    FringeDirection direction,
                    double sign = 1.0,
                    bool is_exchanged = false) {
  AbsolutePhase out{.pattern = {.name = "f", .direction = direction, .period_px = 20.0},
                    .phase_rad = Image<float>(160, 120),
                    .sigma_rad = Image<float>(160, 120, 0.02F),
                    .status = Image<PixelStatus>(160, 120, PixelStatus::Measured)};
  for (int y = 0; y < 120; ++y) {
    for (int x = 0; x < 160; ++x) {
      const double z = 500.0 + 12.0 * std::sin(0.11 * x) + 9.0 * std::cos(0.13 * y + 0.05 * x);
      const Eigen::Vector3d point(z * (x - 80.0) / 300.0, z * (y - 60.0) / 300.0, z);
      const Eigen::Vector3d p = rig.projector.rotation * (point - rig.projector.position_mm);
      const double column = 320.0 + 1000.0 * p.x() / p.z();
      const double row = 240.0 + 1000.0 * p.y() / p.z();
      const bool columns = (direction == FringeDirection::Vertical) != is_exchanged;
      out.phase_rad(x, y) = static_cast<float>(sign * kTurn * (columns ? column : row) / 20.0);
    }
  }
  return out;
}

TEST(CheckOrientation, AcceptsThePhasesOfABumpySurface) {
  const Rig rig = crossed_rig();
  const auto rays = rays_of(rig.reference().model);
  for (const auto direction : {FringeDirection::Vertical, FringeDirection::Horizontal}) {
    const OrientationCheck found = check_orientation(bumpy(rig, direction), rig, rays);
    EXPECT_TRUE(found.decided);
    EXPECT_TRUE(found.consistent) << found.fits;
    EXPECT_GT(found.rising, 0.95);
  }
}

TEST(CheckOrientation, DoesNotTakeFineFringesForFallingOnes) {
  // 3.3 projector pixels a camera pixel: a fringe of 8 spans 2.4 camera pixels, one of 14 spans 4.
  const Rig rig = crossed_rig();
  const auto rays = rays_of(rig.reference().model);
  for (const double period : {5.0, 8.0, 10.0, 14.0}) {
    for (const auto direction : {FringeDirection::Vertical, FringeDirection::Horizontal}) {
      AbsolutePhase phase = bumpy(rig, direction);
      phase.pattern.period_px = period;
      for (float& value : phase.phase_rad.pixels())
        value =
            static_cast<float>(std::remainder(static_cast<double>(value) * 20.0 / period, kTurn));
      const OrientationCheck found = check_orientation(phase, rig, rays);
      EXPECT_TRUE(found.consistent) << period << ": " << found.fits;
      EXPECT_TRUE(found.decided || period < 13.0) << period;
    }
  }
}

TEST(CheckOrientation, NamesAPhaseThatFallsInsteadOfRises) {
  const Rig rig = crossed_rig();
  const auto rays = rays_of(rig.reference().model);
  for (const auto direction : {FringeDirection::Vertical, FringeDirection::Horizontal}) {
    const OrientationCheck found = check_orientation(bumpy(rig, direction, -1.0), rig, rays);
    EXPECT_TRUE(found.decided);
    EXPECT_FALSE(found.consistent);
    EXPECT_NE(found.fits.find("mirrored"), std::string::npos) << found.fits;
  }
}

TEST(CheckOrientation, NamesRowsThatAreExchangedWithColumns) {
  const Rig rig = crossed_rig();
  const auto rays = rays_of(rig.reference().model);
  const OrientationCheck vertical =
      check_orientation(bumpy(rig, FringeDirection::Vertical, 1.0, true), rig, rays);
  EXPECT_FALSE(vertical.consistent);
  EXPECT_NE(vertical.fits.find("direction = \"horizontal\" fits"), std::string::npos);
  const OrientationCheck horizontal =
      check_orientation(bumpy(rig, FringeDirection::Horizontal, 1.0, true), rig, rays);
  EXPECT_FALSE(horizontal.consistent);
  EXPECT_NE(horizontal.fits.find("direction = \"vertical\" fits"), std::string::npos);
}

TEST(CheckOrientation, DecidesForANarrowPart) {
  Rig rig = crossed_rig();
  rig.reference().model.width_px = 640;
  rig.reference().model.height_px = 480;
  const auto rays = rays_of(rig.reference().model);
  const AbsolutePhase whole = bumpy(crossed_rig(), FringeDirection::Vertical, -1.0);
  AbsolutePhase narrow{.pattern = whole.pattern,
                       .phase_rad = Image<float>(640, 480, std::nanf("")),
                       .sigma_rad = Image<float>(640, 480, 0.02F),
                       .status = Image<PixelStatus>(640, 480, PixelStatus::Unmodulated)};
  for (int y = 0; y < 120; ++y) {
    for (int x = 70; x < 90; ++x)
      narrow.phase_rad(x, y) = whole.phase_rad(x, y);
  }
  const OrientationCheck found = check_orientation(narrow, rig, rays);
  EXPECT_TRUE(found.decided);
  EXPECT_FALSE(found.consistent);
}

TEST(CheckOrientation, DecidesNothingForAnEmptyPhase) {
  const Rig rig = crossed_rig();
  AbsolutePhase phase = bumpy(rig, FringeDirection::Vertical);
  phase.phase_rad = Image<float>(160, 120, std::nanf(""));
  const OrientationCheck found = check_orientation(phase, rig, rays_of(rig.reference().model));
  EXPECT_FALSE(found.decided);
  EXPECT_TRUE(found.consistent);
}

}  // namespace
}  // namespace frangia
