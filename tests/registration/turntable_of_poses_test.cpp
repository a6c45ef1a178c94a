// The axis of a turntable from poses of its views.
#include "frangia/registration/turntable_of_poses.h"

#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "frangia/core/angles.h"

namespace frangia {
namespace {

Turntable tilted_table() {
  Turntable table;
  table.point_mm = {4.0, 30.0, 480.0};
  table.axis = Eigen::Vector3d(0.05, -0.9, -0.4).normalized();
  return table;
}

std::vector<double> in_rad(std::vector<double> degrees) {
  for (double& angle : degrees)
    angle = rad_from_deg(angle);
  return degrees;
}

/// Poses of the views of a part whose own frame is anywhere.
std::vector<Eigen::Isometry3d> poses_on(const Turntable& table, const std::vector<double>& angles) {
  const Eigen::Isometry3d anywhere = Eigen::Translation3d(20.0, -7.0, 3.0) *
                                     Eigen::AngleAxisd(1.1, Eigen::Vector3d(1, 2, 3).normalized());
  std::vector<Eigen::Isometry3d> poses;
  for (const double angle : angles)
    poses.push_back(table.rig_from_object(angle) * anywhere);
  return poses;
}

double distance_mm(const Turntable& one, const Turntable& other) {
  const Eigen::Vector3d apart = one.point_mm - other.point_mm;
  return (apart - apart.dot(other.axis) * other.axis).norm();
}

TEST(TurntableOfPoses, IsTheAxisThatAllViewsTurnedAbout) {
  const Turntable truth = tilted_table();
  const std::vector<double> angles = in_rad({0, 60, 120, 180, 240, 300});
  const TurntableOfPoses found = turntable_of_poses(poses_on(truth, angles), angles);
  EXPECT_EQ(found.views.size(), 6U);
  EXPECT_LT((found.table.axis - truth.axis).norm(), 1e-9);
  EXPECT_LT(distance_mm(found.table, truth), 1e-6);
}

TEST(TurntableOfPoses, LeavesOutAViewThatFitsElsewhere) {
  const Turntable truth = tilted_table();
  const std::vector<double> angles = in_rad({0, 60, 120, 180, 240, 300});
  std::vector<Eigen::Isometry3d> poses = poses_on(truth, angles);
  poses[2] = poses[2] * Eigen::AngleAxisd(0.4, Eigen::Vector3d::UnitX());
  const TurntableOfPoses found = turntable_of_poses(poses, angles);
  EXPECT_EQ(found.views, (std::vector<std::size_t>{0, 1, 3, 4, 5}));
  EXPECT_LT(distance_mm(found.table, truth), 1e-6);
}

TEST(TurntableOfPoses, FindsNoneWherePosesDoNotFollowTheAngles) {
  const std::vector<double> angles = in_rad({0, 60, 120, 200});
  std::vector<Eigen::Isometry3d> still(4, tilted_table().rig_from_object(0.0));
  EXPECT_TRUE(turntable_of_poses(still, angles).views.empty());
  EXPECT_TRUE(turntable_of_poses(still, in_rad({0, 180, 0, 180})).views.empty());
}

}  // namespace
}  // namespace frangia
