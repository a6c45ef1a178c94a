// The truth is made by OpenCV's own projection, so that an error of convention of ours cannot
// cancel.
#include "frangia/calibrate/solve_rig.h"

#include <cmath>
#include <random>

#include <gtest/gtest.h>
#include <opencv2/calib3d.hpp>

namespace frangia {
namespace {

const Board kBoard{10, 7, 15.0};
const RigSizes kSizes{1280, 1024, 1280, 800};

/// A rig as OpenCV has it.
struct TrueRig {
  cv::Mat camera =
      (cv::Mat_<double>(3, 3) << 2400.0, 0.0, 646.8, 0.0, 2400.0, 507.4, 0.0, 0.0, 1.0);
  cv::Mat camera_distortion = (cv::Mat_<double>(1, 5) << -0.09, 0.05, 4e-4, -3e-4, 0.0);
  cv::Mat projector =
      (cv::Mat_<double>(3, 3) << 1800.0, 0.0, 632.0, 0.0, 1800.0, 780.0, 0.0, 0.0, 1.0);
  cv::Mat projector_distortion = (cv::Mat_<double>(1, 5) << -0.03, 0.0, 0.0, 0.0, 0.0);
  cv::Mat rotation = (cv::Mat_<double>(3, 1) << 0.02, 0.38, -0.01);  // projector_from_camera
  cv::Mat translation = (cv::Mat_<double>(3, 1) << -190.0, 4.0, 40.0);
};

std::vector<BoardView> make_views(const TrueRig& rig, int count, double noise_px, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> even(-1.0, 1.0);
  std::normal_distribution<double> normal(0.0, 1.0);
  const std::vector<Eigen::Vector2d> nominal = board_points_mm(kBoard);
  const Eigen::Vector2d center = 0.5 * (nominal.front() + nominal.back());
  std::vector<cv::Point3d> board;
  for (const Eigen::Vector2d& point : nominal)
    board.emplace_back(point.x() - center.x(), point.y() - center.y(), 0.0);
  std::vector<BoardView> views;
  for (int i = 0; i < count; ++i) {
    const cv::Mat turn = (cv::Mat_<double>(3, 1) << 0.5 * even(random),
                          0.2 + 0.5 * even(random),
                          0.3 * even(random));
    const cv::Mat place = (cv::Mat_<double>(3, 1) << 40.0 * even(random),
                           30.0 * even(random),
                           480.0 + 60.0 * even(random));
    std::vector<cv::Point2d> seen;
    std::vector<cv::Point2d> lit;
    cv::projectPoints(board, turn, place, rig.camera, rig.camera_distortion, seen);
    cv::Mat turn2;
    cv::Mat place2;
    cv::composeRT(turn, place, rig.rotation, rig.translation, turn2, place2);
    cv::projectPoints(board, turn2, place2, rig.projector, rig.projector_distortion, lit);
    BoardView view{"pose " + std::to_string(i), {}};
    for (std::size_t k = 0; k < board.size(); ++k) {
      BoardPoint point;
      point.index = static_cast<int>(k);
      point.camera_px = {seen[k].x + noise_px * normal(random),
                         seen[k].y + noise_px * normal(random)};
      point.projector_px = {lit[k].x + noise_px * normal(random),
                            lit[k].y + noise_px * normal(random)};
      point.projector_sigma_px = Eigen::Vector2d::Constant(0.05);  // stated half of what it is
      view.points.push_back(point);
    }
    views.push_back(view);
  }
  return views;
}

TEST(SolveRig, FindsTheRigThatOpenCvProjectedWith) {
  const TrueRig rig;
  const RigSolution found = solve_rig(kBoard, make_views(rig, 12, 1e-4, 1), kSizes);
  EXPECT_NEAR(found.camera.focal_px.x(), 2400.0, 0.05);
  EXPECT_NEAR(found.camera.principal_point_px.x(), 646.8, 0.05);
  EXPECT_NEAR(found.camera.principal_point_px.y(), 507.4, 0.05);
  EXPECT_NEAR(found.camera.distortion[0], -0.09, 1e-3);
  EXPECT_NEAR(found.camera.distortion[2], 4e-4, 1e-5);
  EXPECT_NEAR(found.projector.focal_px.x(), 1800.0, 0.05);
  EXPECT_NEAR(found.projector.principal_point_px.y(), 780.0, 0.1);
  EXPECT_NEAR(found.projector_from_camera.translation().x(), -190.0, 0.01);
  EXPECT_NEAR(found.projector_from_camera.translation().z(), 40.0, 0.02);
  EXPECT_LT(found.camera_residuals.rms_px, 2e-4);
  EXPECT_TRUE(found.undetermined.empty());
}

TEST(SolveRig, ErrorsAreAsLargeAsTheCovarianceStates) {
  const TrueRig rig;
  double squares = 0.0;
  double count = 0.0;
  for (unsigned seed = 1; seed <= 8; ++seed) {
    const RigSolution found = solve_rig(kBoard, make_views(rig, 10, 0.1, seed), kSizes);
    ASSERT_FALSE(found.parameters.empty());
    for (std::size_t i = 0; i < found.parameters.size(); ++i) {
      double error = 0.0;
      if (found.parameters[i] == "camera.focal_px")
        error = found.camera.focal_px.x() - 2400.0;
      else if (found.parameters[i] == "camera.principal_x_px")
        error = found.camera.principal_point_px.x() - 646.8;
      else if (found.parameters[i] == "camera.principal_y_px")
        error = found.camera.principal_point_px.y() - 507.4;
      else if (found.parameters[i] == "projector.focal_px")
        error = found.projector.focal_px.x() - 1800.0;
      else if (found.parameters[i] == "projector.principal_y_px")
        error = found.projector.principal_point_px.y() - 780.0;
      else if (found.parameters[i] == "projector.x_mm")
        error = found.projector_from_camera.translation().x() + 190.0;
      else if (found.parameters[i] == "projector.z_mm")
        error = found.projector_from_camera.translation().z() - 40.0;
      else
        continue;
      const auto row = static_cast<Eigen::Index>(i);
      squares += error * error / found.covariance(row, row);
      count += 1.0;
    }
  }
  EXPECT_NEAR(std::sqrt(squares / count), 1.0, 0.35) << count;
}

TEST(SolveRig, NamesTheViewsThatAreTooFew) {
  EXPECT_THROW(static_cast<void>(solve_rig(kBoard, make_views({}, 2, 0.1, 1), kSizes)), Error);
}

}  // namespace
}  // namespace frangia
