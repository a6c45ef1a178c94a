#pragma once

#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "frangia/core/image.h"

namespace frangia {

/// Where camera and projector see one point of the board.
struct BoardPoint {
  int index = 0;                                        ///< of `board_points_mm`
  Eigen::Vector2d camera_px = Eigen::Vector2d::Zero();  ///< in the camera image
  /// Projector pixel that lights the point, from the phases of both fringe directions; NaN where a
  /// phase is missing.
  Eigen::Vector2d projector_px =
      Eigen::Vector2d::Constant(std::numeric_limits<double>::quiet_NaN());
  /// Standard deviation of `projector_px` as the phase noise predicts it.
  Eigen::Vector2d projector_sigma_px =
      Eigen::Vector2d::Constant(std::numeric_limits<double>::quiet_NaN());
  /// Derivative of `projector_px` with respect to the camera pixel, on the surface around the
  /// point. An error of `camera_px` moves `projector_px` by it, because the phase is read at that
  /// pixel. Zero where `projector_px` is measured independently.
  Eigen::Matrix2d projector_by_camera = Eigen::Matrix2d::Zero();
};

/// A small picture of the board for a report.
struct BoardPicture {
  Image<std::uint8_t> pixels;  ///< of the mean intensity, scaled to its brightest
  double px_per_px = 1.0;      ///< camera pixels per pixel of the picture
};

/// One pose of the board.
struct BoardView {
  std::string name;                ///< of the view's folder, for messages
  std::vector<BoardPoint> points;  ///< those that the reference camera found
  /// Those that each further camera found, in their order in the rig; none where it does
  /// not see the board.
  std::vector<std::vector<BoardPoint>> more{};
};

/// The points that a camera found: 0 is the reference camera, the further ones follow.
[[nodiscard]] inline const std::vector<BoardPoint>& points_of(const BoardView& view,
                                                              std::size_t camera) {
  return camera == 0 ? view.points : view.more.at(camera - 1);
}

}  // namespace frangia
