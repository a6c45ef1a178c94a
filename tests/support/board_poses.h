// Poses of a board, projected by OpenCV, so that an error in our own convention cannot cancel out.
#pragma once

#include <cmath>
#include <random>
#include <string>
#include <vector>

#include <opencv2/calib3d.hpp>

#include "frangia/calibrate/board/board_view.h"
#include "frangia/rig/board.h"
#include "frangia/rig/rig.h"

namespace frangia::testing {

inline const Board kBoard{
    .kind = BoardKind::Checkerboard, .columns = 10, .rows = 7, .square_mm = 15.0};

/// A rig of which only the sizes are known.
inline Rig known_rig() {
  const Eigen::Vector2d unknown = Eigen::Vector2d::Constant(std::nan(""));
  Rig rig;
  rig.reference().model = {
      .width_px = 1280, .height_px = 1024, .focal_px = unknown, .principal_point_px = unknown};
  rig.projector.model = PinholeModel{
      .width_px = 1280, .height_px = 800, .focal_px = unknown, .principal_point_px = unknown};
  rig.projector.position_mm.setConstant(std::nan(""));
  return rig;
}

/// A rig in the convention of OpenCV.
struct TrueRig {
  cv::Mat camera =
      (cv::Mat_<double>(3, 3) << 2400.0, 0.0, 646.8, 0.0, 2400.0, 507.4, 0.0, 0.0, 1.0);
  cv::Mat camera_distortion = (cv::Mat_<double>(1, 5) << -0.09, 0.05, 4e-4, -3e-4, 0.0);
  cv::Mat projector =
      (cv::Mat_<double>(3, 3) << 1800.0, 0.0, 632.0, 0.0, 1800.0, 420.0, 0.0, 0.0, 1.0);
  cv::Mat projector_distortion = (cv::Mat_<double>(1, 5) << -0.03, 0.0, 0.0, 0.0, 0.0);
  cv::Mat rotation = (cv::Mat_<double>(3, 1) << 0.02, 0.38, -0.01);  // projector_from_camera
  cv::Mat translation = (cv::Mat_<double>(3, 1) << -190.0, 4.0, 40.0);
};

/// Poses that are tilted by up to `tilt` rad about each axis.
inline std::vector<BoardView> make_views(
    const TrueRig& rig, int count, double noise_px, unsigned seed, double tilt = 0.5) {
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
    const cv::Mat turn = (cv::Mat_<double>(3, 1) << tilt * even(random),
                          0.2 + tilt * even(random),
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
      point.projector_sigma_px =
          Eigen::Vector2d::Constant(0.05);  // not the true noise, which is `noise_px`
      view.points.push_back(point);
    }
    views.push_back(view);
  }
  return views;
}

}  // namespace frangia::testing
