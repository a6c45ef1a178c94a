#include <cmath>

#include <gtest/gtest.h>

#include "frangia/calibrate/report/residual_maps.h"
#include "frangia/core/angles.h"

namespace frangia {
namespace {

/// A result of poses, each of one point of the board, whose residuals are given.
RigCalibration result_of(const std::vector<double>& camera_px,
                         const std::vector<double>& projector_px) {
  RigCalibration result;
  RigSolution& solution = result.solution;
  solution.cameras.front().model.width_px = 640;
  solution.cameras.front().model.height_px = 480;
  solution.projector.width_px = 1280;
  solution.projector.height_px = 800;
  for (std::size_t i = 0; i < camera_px.size(); ++i) {
    BoardView view;
    view.name = "views/" + std::to_string(i);
    BoardPoint point;
    point.camera_px = {10.0 * static_cast<double>(i), 20.0};
    point.projector_px = {100.0, 30.0};
    view.points = {point};
    result.views.push_back(view);
    solution.cameras.front().residuals_px.push_back({{camera_px[i], 0.0}});
    solution.cameras.front().projector_residuals_px.push_back({{0.0, projector_px[i]}});
    const auto summary = [](double px) {
      return ResidualSummary{.rms_px = std::abs(px), .max_px = std::abs(px), .points = 1};
    };
    solution.cameras.front().by_view.push_back(summary(camera_px[i]));
    solution.cameras.front().projector_by_view.push_back(summary(projector_px[i]));
    Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
    pose.rotate(Eigen::AngleAxisd(rad_from_deg(30.0), Eigen::Vector3d::UnitX()));
    pose.pretranslate(Eigen::Vector3d(0.0, 300.0, 400.0));
    solution.camera_from_board.push_back(pose);
    solution.leave_one_out_mm.push_back(0.01 * static_cast<double>(i));
  }
  return result;
}

TEST(CalibrateResiduals, NamesThePoseFarAboveTheMedian) {
  const auto poses = pose_residuals(result_of({0.1, 0.12, 0.9, 0.11}, {0.2, 0.2, 0.2, 2.0}));
  ASSERT_EQ(poses.size(), 4U);
  EXPECT_FALSE(poses[0].is_outlier);
  EXPECT_FALSE(poses[1].is_outlier);
  EXPECT_TRUE(poses[2].is_outlier) << "of the camera";
  EXPECT_TRUE(poses[3].is_outlier) << "of the projector";
  EXPECT_EQ(poses[2].name, "views/2");
  EXPECT_NEAR(poses[2].camera_rms_px, 0.9, 1e-12);
  EXPECT_NEAR(poses[0].distance_mm, 500.0, 1e-9);
  EXPECT_NEAR(deg_from_rad(poses[0].tilt_rad), 30.0, 1e-9);
  EXPECT_NEAR(poses[3].change_mm, 0.03, 1e-12);
}

TEST(CalibrateResiduals, MapsEachPointToItsPlaceAndLeavesMissingOnesOut) {
  const auto maps = residual_maps(result_of({0.1, std::nan("")}, {0.3, 0.4}));
  ASSERT_EQ(maps.size(), 2U);
  ASSERT_EQ(maps[0].arrows.size(), 1U);
  EXPECT_EQ(maps[0].arrows[0].from, Eigen::Vector2d(0.0, 20.0));
  EXPECT_EQ(maps[0].arrows[0].residual, Eigen::Vector2d(0.1, 0.0));
  EXPECT_EQ(maps[1].width, 1280);
  ASSERT_EQ(maps[1].arrows.size(), 2U);
  EXPECT_EQ(maps[1].arrows[1].from, Eigen::Vector2d(100.0, 30.0));
  EXPECT_EQ(maps[1].arrows[1].residual, Eigen::Vector2d(0.0, 0.4));
}

}  // namespace
}  // namespace frangia
