#include "frangia/range/fuse_cameras.h"

#include <array>
#include <cmath>
#include <string>

#include <gtest/gtest.h>

#include "frangia/core/angles.h"
#include "frangia/range/triangulate.h"

#include "range/two_cameras.h"

namespace frangia {
namespace {

using testing::Errors;
using testing::errors_of;
using testing::kCoarse_px;
using testing::kNone;
using testing::TwoCameras;

/// The same errors over sigma as fusion counts it: a point's own share of the information.
constexpr double kShared = 1.4142;

TEST(FuseCameras, HalvesTheVarianceWithoutBiasWhereverTheSecondCameraStands) {
  const std::array<Eigen::Vector3d, 4> places{Eigen::Vector3d{150.0, 0.0, 20.0},
                                              Eigen::Vector3d{-270.0, 5.0, 60.0},
                                              Eigen::Vector3d{30.0, -140.0, 10.0},
                                              Eigen::Vector3d{120.0, 90.0, 80.0}};
  for (const Eigen::Vector3d& place : places) {
    SCOPED_TRACE(place.transpose());
    TwoCameras scene({.second_mm = place});
    const CameraDisagreement found = fuse_cameras(scene.cameras, scene.ranges);
    EXPECT_GT(found.pixels, 500U);
    EXPECT_NEAR(found.median_over_sigma, 0.6745, 0.12);
    EXPECT_LT(found.removed, 10U);
    for (const std::size_t camera : {0U, 1U}) {
      const Errors before = errors_of(scene, camera, scene.alone);
      const Errors after = errors_of(scene, camera, scene.ranges);
      EXPECT_GE(after.points + 10, before.points);
      EXPECT_LT(after.rms_mm, 0.9 * before.rms_mm);
      EXPECT_LT(std::abs(after.mean_mm), 0.1 * after.rms_mm);
      EXPECT_GT(kShared * after.over_sigma, 0.7);
      EXPECT_LT(kShared * after.over_sigma, 1.2);
    }
  }
}

TEST(FuseCameras, ScalesWithTheRig) {
  TwoCameras plain({});
  static_cast<void>(fuse_cameras(plain.cameras, plain.ranges));
  const Errors wanted = errors_of(plain, 0, plain.ranges);
  for (const double scale : {0.1, 10.0}) {
    TwoCameras scaled({.scale = scale});
    static_cast<void>(fuse_cameras(scaled.cameras, scaled.ranges));
    const Errors found = errors_of(scaled, 0, scaled.ranges);
    EXPECT_NEAR(static_cast<double>(found.points), static_cast<double>(wanted.points), 5.0);
    EXPECT_NEAR(found.rms_mm / scale, wanted.rms_mm, 0.01 * wanted.rms_mm);
    EXPECT_NEAR(found.over_sigma, wanted.over_sigma, 0.01);
  }
}

TEST(FuseCameras, CancelsHarmonicsThatBothCamerasSee) {
  constexpr double kHarmonic_rad = 0.15;
  TwoCameras scene({.harmonic_rad = kHarmonic_rad, .period_px = kCoarse_px});
  static_cast<void>(fuse_cameras(scene.cameras, scene.ranges));
  const Errors before = errors_of(scene, 0, scene.alone);
  const Errors after = errors_of(scene, 0, scene.ranges);
  EXPECT_LT(after.rms_mm, 0.5 * before.rms_mm);
  EXPECT_GT(kShared * after.over_sigma, 0.7);
  EXPECT_LT(kShared * after.over_sigma, 1.5);
}

TEST(FuseCameras, MatchesTwoCamerasByALabelWhoseCalibrationIsNotKnown) {
  for (const int directions : {1, 2}) {
    for (const Eigen::Vector3d& place :
         {Eigen::Vector3d{150.0, 0.0, 20.0}, Eigen::Vector3d{-150.0, 30.0, 60.0}}) {
      SCOPED_TRACE(place.transpose());
      TwoCameras scene({.second_mm = place, .label = true, .directions = directions});
      for (Rig& rig : scene.rigs) {  // nothing of it may be used
        rig.projector.position_mm.setConstant(kNone);
        rig.projector.rotation.setConstant(kNone);
      }
      static_cast<void>(fuse_cameras(scene.cameras, scene.ranges));
      const Errors found = errors_of(scene, 0, scene.ranges);
      EXPECT_GT(found.points, 3000U);
      EXPECT_LT(std::abs(found.mean_mm), 0.1 * found.rms_mm);
      EXPECT_LT(found.rms_mm, 1.0);
      EXPECT_GT(kShared * found.over_sigma, 0.7);
      EXPECT_LT(kShared * found.over_sigma, 1.2);
    }
  }
}

TEST(FuseCameras, MatchesALabelDespiteHarmonics) {
  constexpr double kHarmonic_rad = 0.15;
  TwoCameras projector({.harmonic_rad = kHarmonic_rad, .period_px = kCoarse_px});
  TwoCameras label({.label = true, .harmonic_rad = kHarmonic_rad, .period_px = kCoarse_px});
  static_cast<void>(fuse_cameras(label.cameras, label.ranges));
  const Errors alone = errors_of(projector, 0, projector.alone);
  const Errors found = errors_of(label, 0, label.ranges);
  EXPECT_LT(found.rms_mm, 0.5 * alone.rms_mm);
  EXPECT_GT(kShared * found.over_sigma, 0.7);
  EXPECT_LT(kShared * found.over_sigma, 1.5);
}

TEST(FuseCameras, SeesACameraThatHasTurned) {
  for (const bool label : {false, true}) {
    TwoCameras sound({.label = label, .directions = 2});
    TwoCameras turned({.label = label, .directions = 2, .turned_rad = rad_from_deg(0.2)});
    const CameraDisagreement before = fuse_cameras(sound.cameras, sound.ranges);
    const CameraDisagreement after = fuse_cameras(turned.cameras, turned.ranges);
    EXPECT_LT(before.median_over_sigma, 0.8);
    EXPECT_GT(after.median_over_sigma, 2.0);
    EXPECT_GT(after.median_mm, 2.0 * before.median_mm);
    const Errors errors = errors_of(turned, 0, turned.ranges);
    EXPECT_GT(errors.points, 3000U);
    EXPECT_LT(errors.over_sigma, 1.5);  // the difference has entered the systematic part
  }
}

TEST(FuseCameras, RemovesPointsThatAnotherCameraContradicts) {
  // A patch whose fringe order is off by one hangs in front of the ball, where the second camera
  // sees through it, or lies behind points that the second camera sees.
  for (const double fringes : {1.0, -1.0}) {
    SCOPED_TRACE(fringes);
    TwoCameras scene({});
    for (int y = 60; y < 66; ++y) {
      for (int x = 76; x < 82; ++x)
        scene.phases[0][0].phase_rad(x, y) += static_cast<float>(fringes * kTwoPi);
    }
    scene.ranges[0] = triangulate(scene.phases[0].front(), scene.rigs[0], scene.rays[0]);
    ASSERT_FALSE(std::isnan(scene.ranges[0].depth_mm(79, 63)));
    const CameraDisagreement found = fuse_cameras(scene.cameras, scene.ranges);
    EXPECT_GE(found.removed, 16U);
    EXPECT_TRUE(std::isnan(scene.ranges[0].depth_mm(79, 63)));
    EXPECT_FALSE(std::isnan(scene.ranges[0].depth_mm(60, 63)));
  }
}

TEST(FuseCameras, KeepsPointsThatABeadHidesFromTheOtherCamera) {
  TwoCameras scene({.bead = true});
  // The second camera sees the ball where the first one sees the bead in front of it.
  const Eigen::Isometry3d second = scene.truth_from_rig();
  std::size_t hidden = 0;
  const auto for_each_hidden = [&](const auto& use) {
    const Image<float>& depth = scene.alone[1].depth_mm;
    for (int y = 0; y < depth.height(); ++y) {
      for (int x = 0; x < depth.width(); ++x) {
        if (std::isnan(depth(x, y))) continue;
        const Eigen::Vector3d point =
            second.inverse() *
            (static_cast<double>(depth(x, y)) * scene.rays[1](x, y).cast<double>().homogeneous());
        const double seen = scene.depth_of(point.hnormalized(), Eigen::Isometry3d::Identity());
        if (seen < point.z() - 20.0) use(x, y);
      }
    }
  };
  for_each_hidden([&](int, int) { ++hidden; });
  ASSERT_GT(hidden, 40U);
  const CameraDisagreement found = fuse_cameras(scene.cameras, scene.ranges);
  EXPECT_LT(found.removed, 10U);
  for_each_hidden([&](int x, int y) { EXPECT_FALSE(std::isnan(scene.ranges[1].depth_mm(x, y))); });
}

}  // namespace
}  // namespace frangia
