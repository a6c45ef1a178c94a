#include "frangia/calibrate/board/pose_coverage.h"

#include <vector>

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include "frangia/core/angles.h"

namespace frangia {
namespace {

const Board kSquares{.kind = BoardKind::Checkerboard, .columns = 10, .rows = 7, .square_mm = 20.0};

CameraModel camera_of(double focal_px) {
  return {.width_px = 1200,
          .height_px = 900,
          .focal_px = {focal_px, focal_px},
          .principal_point_px = {599.5, 449.5}};
}

/// The board at a place, turned about an axis through its middle.
BoardView seen(const CameraModel& camera,
               const Eigen::Vector3d& place_mm,
               const Eigen::Vector3d& axis = Eigen::Vector3d::UnitX(),
               double turn_deg = 0.0) {
  const Eigen::AngleAxisd turn(rad_from_deg(turn_deg), axis);
  BoardView view{"view", {}};
  int index = 0;
  for (const Eigen::Vector2d& point : board_points_mm(kSquares)) {
    const Eigen::Vector3d on_board(point.x() - 90.0, point.y() - 60.0, 0.0);
    view.points.push_back({index++, camera.project(place_mm + turn * on_board)});
  }
  return view;
}

TEST(PoseCoverage, MeasuresTiltsDistancesAndCells) {
  const CameraModel camera = camera_of(1500.0);
  // A turn about y by +25 degrees moves the right side (x > 0) to smaller z: nearer.
  const std::vector<BoardView> views{
      seen(camera, {0.0, 0.0, 600.0}, Eigen::Vector3d::UnitY(), 25.0),
      seen(camera, {0.0, 0.0, 720.0}, Eigen::Vector3d::UnitX(), 20.0)};
  const PoseCoverage coverage = measure_pose_coverage(views, kSquares, camera);
  EXPECT_EQ(coverage.poses, 2U);
  EXPECT_NEAR(coverage.tilts_deg[0], 25.0, 0.5);  // left side away
  EXPECT_NEAR(coverage.tilts_deg[1], 0.0, 0.5);
  // A turn about x by +20 degrees moves the lower side (y > 0) to larger z.
  EXPECT_NEAR(coverage.tilts_deg[3], 20.0, 0.5);
  EXPECT_NEAR(coverage.farthest / coverage.nearest, 1.2, 0.01);
  EXPECT_FALSE(coverage.cells[0]);
  EXPECT_TRUE(coverage.cells[5]);
  EXPECT_FALSE(coverage.sufficient());
}

TEST(PoseCoverage, AsksForWhatIsMissingMost) {
  const CameraModel camera = camera_of(1500.0);
  std::vector<BoardView> views;
  for (const double turn_deg : {30.0, -30.0}) {
    views.push_back(seen(camera, {0.0, 0.0, 600.0}, Eigen::Vector3d::UnitY(), turn_deg));
    views.push_back(seen(camera, {0.0, 0.0, 600.0}, Eigen::Vector3d::UnitX(), turn_deg));
  }
  EXPECT_NE(
      measure_pose_coverage(views, kSquares, camera).next.text().find("by a tenth of its distance"),
      std::string::npos);
  for (const double x : {-150.0, 150.0}) {
    for (const double y : {-110.0, 110.0})
      views.push_back(seen(camera, {x, y, 720.0}));
  }
  const PoseCoverage all = measure_pose_coverage(views, kSquares, camera);
  EXPECT_TRUE(all.sufficient()) << all.next.text();
  EXPECT_NE(all.next.text().find("sufficient"), std::string::npos);
  views.push_back({"view", {}});
  EXPECT_NE(measure_pose_coverage(views, kSquares, camera).next.text().find("the same place again"),
            std::string::npos);
}

TEST(PoseCoverage, NeedsNoFocalLength) {
  CameraModel unknown = camera_of(1500.0);
  const std::vector<BoardView> views{
      seen(unknown, {0.0, 0.0, 600.0}, Eigen::Vector3d::UnitY(), 25.0)};
  unknown.focal_px.setConstant(std::nan(""));
  EXPECT_NEAR(measure_pose_coverage(views, kSquares, unknown).tilts_deg[0], 25.0, 6.0);
}

}  // namespace
}  // namespace frangia
