#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "frangia/local_fit/surfel_map.h"
#include "frangia/registration/internal/free_pose_bundle.h"
#include "frangia/registration/register_poses.h"

#include "support/analytic_views.h"

namespace frangia {
namespace {

using testing::look_from;
using testing::Shape;

/// The motions of the second of two views of a part, as one covariance of a displacement of the
/// point `at` in the object frame.
Eigen::Matrix3d covariance_at(const Shape& shape, const Eigen::Vector3d& at, double prior_mm) {
  const CameraModel camera = testing::small_camera_model(160, 800.0);
  ViewStore views =
      testing::snapshots(shape, camera, {look_from(0.0, 0.1, 650.0), look_from(0.12, 0.1, 650.0)});
  const auto maps = make_surfel_maps(views, camera, 40000);
  RegisterPosesOptions options;
  options.reach_mm = 1.0;
  options.prior_mm = prior_mm;
  const PosesReport report = register_poses(views, maps, camera, options);
  EXPECT_EQ(report.motions.size(), 2U);
  if (report.motions.size() != 2) return Eigen::Matrix3d::Zero();
  EXPECT_TRUE(report.motions[0].isZero());
  Eigen::Matrix3Xd moved(3, report.motions[1].cols());
  for (Eigen::Index i = 0; i < moved.cols(); ++i) {
    const Eigen::Vector3d turn = report.motions[1].col(i).head<3>();
    moved.col(i) = turn.cross(at) + report.motions[1].col(i).tail<3>();
  }
  return moved * moved.transpose();
}

TEST(FreePoseMotions, AreThoseOfThePriorAlongAFaceThatSlides) {
  const Eigen::Vector3d on_face(20.0, 0.0, 0.0);
  const Eigen::Matrix3d covariance =
      covariance_at(testing::box({20.0, 200.0, 200.0}), on_face, 0.5);
  EXPECT_LT(std::sqrt(covariance(0, 0)), 0.02);  // along its normal
  EXPECT_GT(std::sqrt(covariance(1, 1)), 0.3);
  EXPECT_GT(std::sqrt(covariance(2, 2)), 0.3);
}

TEST(FreePoseMotions, AreSmallWhereTheShapeHolds) {
  const Eigen::Matrix3d covariance = covariance_at(testing::lumpy, {20.0, 5.0, 5.0}, 0.5);
  EXPECT_LT(std::sqrt(covariance.trace()), 0.05);
}

}  // namespace
}  // namespace frangia
