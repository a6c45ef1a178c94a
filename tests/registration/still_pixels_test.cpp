#include "frangia/registration/internal/still_pixels.h"

#include <vector>

#include <gtest/gtest.h>

#include "support/analytic_views.h"

namespace frangia {
namespace {

/// What the middle pixel says of a wall that faces a camera at 400 mm, 60 mm behind the axis, after
/// turns by 90 degrees. The wall stands still, or is the face of a box that turns.
StillPixel middle_of(const testing::Shape& object, bool turns) {
  const CameraModel camera = testing::small_camera_model(60, 200.0);
  const std::vector<Eigen::Isometry3d> poses = testing::around_table(4, 0.0, 400.0);
  ViewStore views;
  for (const Eigen::Isometry3d& pose : poses) {
    View view = testing::snapshot(object, camera, turns ? pose : poses.front());
    view.rig_from_object = pose;
    views.add(view);
  }
  return compare_views(thin_views(views, camera, std::vector<int>(4, 0)), 30, 28);
}

TEST(CompareViews, SeesThroughThePlaceToWhichTheTableWouldTurnAWall) {
  const testing::Shape wall = [](const Eigen::Vector3d& p) { return p.x() + 60.0; };
  const StillPixel at = middle_of(wall, false);
  EXPECT_NEAR(at.depth_mm, 460.0F, 0.2F);
  EXPECT_EQ(at.agree, 4);
  EXPECT_TRUE(at.usual);
  EXPECT_GT(at.through, at.support);
}

TEST(CompareViews, FindsTheFacesOfACubeWhereTheTableTurnsThem) {
  const StillPixel at = middle_of(testing::box({40.0, 40.0, 40.0}), true);
  EXPECT_NEAR(at.depth_mm, 360.0F, 0.2F);
  EXPECT_EQ(at.agree, 4);
  EXPECT_EQ(at.through, 0);
}

TEST(CompareViews, CountsOneViewOfEachAngle) {
  const testing::Shape wall = [](const Eigen::Vector3d& p) { return p.x() + 60.0; };
  const CameraModel camera = testing::small_camera_model(60, 200.0);
  const View view = testing::snapshot(wall, camera, testing::look_from(0.0, 0.0, 400.0));
  ViewStore views;
  views.add(view);
  views.add(view);
  EXPECT_EQ(thin_views(views, camera, std::vector<int>{0, 0}).views.size(), 1U);
  EXPECT_EQ(thin_views(views, camera, std::vector<int>{0, 1}).views.size(), 2U);
}

}  // namespace
}  // namespace frangia
