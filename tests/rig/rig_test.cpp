#include "frangia/rig/rig.h"

#include <cmath>

#include <gtest/gtest.h>

#include "frangia/core/angles.h"

namespace frangia {
namespace {

const Turntable kTable{.point_mm = {3.5, 55.0, 496.0},
                       .axis = Eigen::Vector3d(0.008, -0.9999, 0.011).normalized()};

TEST(Turntable, ObjectOriginIsThePointOnTheAxis) {
  const Eigen::Vector3d origin = kTable.rig_from_object(0.7) * Eigen::Vector3d::Zero();
  EXPECT_NEAR((origin - kTable.point_mm).norm(), 0.0, 1e-12);
}

TEST(Turntable, ObjectXPointsToTheCameraAtAngleZero) {
  const Eigen::Matrix3d basis = kTable.rig_from_object(0.0).linear();
  EXPECT_GT(basis.col(0).dot(-kTable.point_mm), 0.0);
  EXPECT_NEAR(basis.col(0).dot(kTable.axis), 0.0, 1e-12);
  EXPECT_NEAR((basis.col(2) - kTable.axis).norm(), 0.0, 1e-12);
  EXPECT_NEAR((basis.col(1) - kTable.axis.cross(basis.col(0))).norm(), 0.0, 1e-12);
}

TEST(Turntable, RotatesRightHandedAboutTheAxis) {
  const Eigen::Isometry3d start = kTable.rig_from_object(0.0);
  const Eigen::Isometry3d turned = kTable.rig_from_object(kPi / 2.0);
  // A point on x lies on y after a quarter turn.
  const Eigen::Vector3d seen = turned * Eigen::Vector3d::UnitX();
  EXPECT_NEAR((seen - start * Eigen::Vector3d::UnitY()).norm(), 0.0, 1e-12);
}

TEST(Rig, WithoutATurntableTheObjectFrameIsTheRigFrame) {
  EXPECT_TRUE(Rig{}.rig_from_object(1.0).matrix().isIdentity());
}

}  // namespace
}  // namespace frangia
