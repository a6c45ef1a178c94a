// The truth is a board that OpenCV projects after it has been turned about a known axis.
#include "frangia/calibrate/solve/solve_turntable.h"

#include <array>
#include <cmath>
#include <random>
#include <string>

#include <gtest/gtest.h>

#include "frangia/core/angles.h"

#include "support/board_poses.h"
#include "support/error_of.h"

namespace frangia {
namespace {

using testing::kBoard;
using testing::TrueRig;

Eigen::Vector3d vector_of(const cv::Mat& column) {
  return {column.at<double>(0), column.at<double>(1), column.at<double>(2)};
}

/// The calibrated rig in our convention.
Rig calibrated_rig(const TrueRig& truth) {
  const auto model_of =
      [](const cv::Mat& matrix, const cv::Mat& distortion, int width, int height) {
        CameraModel model;
        model.width_px = width;
        model.height_px = height;
        model.focal_px = {matrix.at<double>(0, 0), matrix.at<double>(1, 1)};
        model.principal_point_px = {matrix.at<double>(0, 2), matrix.at<double>(1, 2)};
        for (int i = 0; i < 5; ++i)
          model.distortion.at(static_cast<std::size_t>(i)) = distortion.at<double>(i);
        return model;
      };
  Rig rig;
  rig.reference().model = model_of(truth.camera, truth.camera_distortion, 1280, 1024);
  rig.projector.model = model_of(truth.projector, truth.projector_distortion, 1280, 800);
  const Eigen::Vector3d turn = vector_of(truth.rotation);
  rig.projector.rotation = Eigen::AngleAxisd(turn.norm(), turn.normalized()).toRotationMatrix();
  rig.projector.position_mm = -(rig.projector.rotation.transpose() * vector_of(truth.translation));
  return rig;
}

const Eigen::Vector3d kPoint(6.0, 60.0, 505.0);
const Eigen::Vector3d kAxis = Eigen::Vector3d(0.03, -0.95, -0.31).normalized();

/// Views of a board that turns about the axis by `step` between views.
std::vector<BoardView> turned_views(int count, double step_rad, double noise_px) {
  const TrueRig truth;
  std::mt19937 random(3);
  std::normal_distribution<double> normal(0.0, noise_px);
  const std::vector<Eigen::Vector2d> nominal = board_points_mm(kBoard);
  const Eigen::Vector2d center = 0.5 * (nominal.front() + nominal.back());
  const Eigen::Isometry3d start =
      Eigen::Translation3d(0.0, -5.0, 500.0) *
      Eigen::AngleAxisd(0.2, Eigen::Vector3d(0.3, 0.9, 0.2).normalized());
  std::vector<BoardView> views;
  for (int i = 0; i < count; ++i) {
    const Eigen::Isometry3d pose = Eigen::Translation3d(kPoint) *
                                   Eigen::AngleAxisd(i * step_rad, kAxis) *
                                   Eigen::Translation3d(-kPoint) * start;
    std::vector<cv::Point3d> points;
    for (const Eigen::Vector2d& place : nominal) {
      const Eigen::Vector3d point =
          pose * Eigen::Vector3d(place.x() - center.x(), place.y() - center.y(), 0.0);
      points.emplace_back(point.x(), point.y(), point.z());
    }
    const cv::Mat none = cv::Mat::zeros(3, 1, CV_64F);
    std::vector<cv::Point2d> seen;
    std::vector<cv::Point2d> lit;
    cv::projectPoints(points, none, none, truth.camera, truth.camera_distortion, seen);
    cv::projectPoints(points,
                      truth.rotation,
                      truth.translation,
                      truth.projector,
                      truth.projector_distortion,
                      lit);
    BoardView view{"view " + std::to_string(i), {}};
    for (std::size_t k = 0; k < points.size(); ++k) {
      BoardPoint point;
      point.index = static_cast<int>(k);
      point.camera_px = {seen[k].x + normal(random), seen[k].y + normal(random)};
      point.projector_px = {lit[k].x + normal(random), lit[k].y + normal(random)};
      view.points.push_back(point);
    }
    views.push_back(view);
  }
  return views;
}

std::vector<double> angles_of(int count, double step_rad) {
  std::vector<double> angles;
  for (int i = 0; i < count; ++i)
    angles.push_back(i * step_rad);
  return angles;
}

TEST(SolveTurntable, FindsTheAxisWithinItsStatedUncertainty) {
  constexpr double kStep = 0.15;
  const auto views = turned_views(7, kStep, 0.1);
  const TurntableSolution found =
      solve_turntable(kBoard, views, angles_of(7, kStep), calibrated_rig({}));
  const double axis_error = std::acos(std::min(1.0, found.turntable.axis.dot(kAxis)));
  const Eigen::Vector3d offset = found.turntable.point_mm - kPoint;
  // At the height of the board, where the distance of the axes counts.
  const Eigen::Vector3d board = found.rig_from_board.translation();
  const Eigen::Vector3d at_board =
      offset + found.turntable.axis * found.turntable.axis.dot(board - found.turntable.point_mm) -
      kAxis * kAxis.dot(board - kPoint);
  EXPECT_LT(axis_error, 4.0 * found.axis_sigma_rad);
  EXPECT_LT(at_board.norm(), 4.0 * found.point_sigma_mm);
  EXPECT_LT(found.axis_sigma_rad, rad_from_deg(0.02));
  EXPECT_LT(found.point_sigma_mm, 0.05);
  EXPECT_LT(found.angle_rms_rad, rad_from_deg(0.01));
  EXPECT_NEAR(found.camera_residuals.rms_px, 0.14, 0.02);
}

TEST(SolveTurntable, MeasuresHowFarTheTableMissesItsAngles) {
  constexpr double kStep = 0.15;
  std::vector<double> stated = angles_of(7, kStep);
  const std::array<double, 7> wrong_deg = {0.2, -0.2, 0.2, -0.2, 0.2, -0.2, 0.0};
  for (std::size_t i = 0; i < stated.size(); ++i)
    stated[i] += rad_from_deg(wrong_deg.at(i));
  const TurntableSolution found =
      solve_turntable(kBoard, turned_views(7, kStep, 0.02), stated, calibrated_rig({}));
  EXPECT_NEAR(deg_from_rad(found.angle_rms_rad), 0.185, 0.03);
}

TEST(SolveTurntable, NeedsThreeViewsAndAnArc) {
  const Rig rig = calibrated_rig({});
  const auto views = turned_views(4, 0.05, 0.1);
  EXPECT_NE(testing::error_of([&] {
              static_cast<void>(solve_turntable(kBoard, views, angles_of(4, 0.05), rig));
            }).find("span 8.6 degrees"),
            std::string::npos);
  EXPECT_NE(testing::error_of([&] {
              static_cast<void>(
                  solve_turntable(kBoard, std::span(views).first(2), angles_of(2, 0.5), rig));
            }).find("found in 2 of at least 3 views"),
            std::string::npos);
}

}  // namespace
}  // namespace frangia
