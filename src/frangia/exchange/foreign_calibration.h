#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include <Eigen/Core>

namespace frangia {

/// A camera or a projector as another program calibrated it, in OpenCV's convention: the centre of
/// the first pixel is at (0, 0).
struct ForeignLens {
  std::optional<Eigen::Matrix3d> matrix;      ///< focal lengths, skew and principal point, px
  std::vector<double> distortion;             ///< OpenCV's order; empty: not stated
  std::optional<std::array<int, 2>> size_px;  ///< width and height; not every program states it

  /// Whether a file stated anything of it.
  [[nodiscard]] bool empty() const { return !matrix && distortion.empty(); }
};

/// What files of another program state about a rig, in OpenCV's convention.
struct ForeignCalibration {
  std::string program;    ///< whose convention was recognized, such as "SLStudio"
  ForeignLens camera;     ///< the first camera of a stereo calibration
  ForeignLens projector;  ///< the second camera of a stereo calibration
  /// projector_from_camera: a point X of the camera frame is R X + t in the projector frame.
  std::optional<Eigen::Matrix3d> rotation;
  std::optional<Eigen::Vector3d> translation;  ///< in the unit of the file
  double mm_per_unit = 1.0;                    ///< of `translation`, where the file states its unit
  /// Values of unknown names that could be part of a calibration, such as "intrinsics (3 x 3)".
  std::vector<std::string> unknown;
};

}  // namespace frangia
