#include "frangia/core/rigid_motion.h"

#include <gtest/gtest.h>

namespace frangia {
namespace {

Eigen::Isometry3d some_motion() {
  return Eigen::Translation3d(3.0, -1.0, 40.0) *
         Eigen::AngleAxisd(2.5, Eigen::Vector3d(1.0, 2.0, -1.0).normalized());
}

TEST(RigidMotion, IsTheOneByWhichThePointsMoved) {
  const Eigen::Matrix3Xd from{{0.0, 10.0, 0.0, 4.0}, {0.0, 0.0, 5.0, 4.0}, {0.0, 0.0, 0.0, 7.0}};
  const Eigen::Isometry3d found = rigid_motion(from, some_motion() * from);
  EXPECT_LT((found.matrix() - some_motion().matrix()).norm(), 1e-12);
}

TEST(RigidMotion, IsARotationForPointsOfAPlane) {
  // Three points leave open whether they were mirrored.
  const Eigen::Matrix3Xd from{{0.0, 10.0, 0.0}, {0.0, 0.0, 5.0}, {0.0, 0.0, 0.0}};
  const Eigen::Isometry3d found = rigid_motion(from, some_motion() * from);
  EXPECT_NEAR(found.linear().determinant(), 1.0, 1e-12);
  EXPECT_LT((found.matrix() - some_motion().matrix()).norm(), 1e-12);
}

TEST(RigidMotion, StaysARotationForMirroredPoints) {
  Eigen::Matrix3Xd from{{0.0, 10.0, 0.0, 4.0}, {0.0, 0.0, 5.0, 4.0}, {0.0, 0.0, 0.0, 7.0}};
  Eigen::Matrix3Xd mirrored = from;
  mirrored.row(0) *= -1.0;
  EXPECT_NEAR(rigid_motion(from, mirrored).linear().determinant(), 1.0, 1e-12);
}

}  // namespace
}  // namespace frangia
