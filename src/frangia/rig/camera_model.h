#pragma once

#include <array>

#include <Eigen/Core>

#include "frangia/core/image.h"
#include "frangia/rig/distortion.h"

namespace frangia {

/// A pinhole camera with the distortion model of OpenCV. A digital projector is an inverse camera
/// and uses the same model. Pixel (0, 0) has its centre at (0, 0).
struct CameraModel {
  int width_px = 0;                                              ///< width of the image
  int height_px = 0;                                             ///< height of the image
  Eigen::Vector2d focal_px = Eigen::Vector2d::Zero();            ///< focal lengths along x and y
  Eigen::Vector2d principal_point_px = Eigen::Vector2d::Zero();  ///< pixel on the optical axis
  /// k1 k2 p1 p2 k3, then k4 k5 k6 s1 s2 s3 s4 tau_x tau_y; see `Distortion`.
  std::array<double, kDistortionCoefficients> distortion{};

  /// Applies the distortion to the normalized point (x/z, y/z).
  [[nodiscard]] Eigen::Vector2d distort(const Eigen::Vector2d& normalized) const;
  /// Returns the derivative of `distort` with respect to its argument.
  [[nodiscard]] Eigen::Matrix2d distort_jacobian(const Eigen::Vector2d& normalized) const;
  /// Inverts `distort` by Newton's method.
  ///
  /// @missing  NaN where the model folds back and has no inverse
  [[nodiscard]] Eigen::Vector2d undistort(const Eigen::Vector2d& distorted) const;

  /// Projects a point of the camera frame, with z > 0, to a pixel.
  [[nodiscard]] Eigen::Vector2d project(const Eigen::Vector3d& point) const;
  /// Returns the normalized point (x/z, y/z) on the ray of a pixel.
  ///
  /// @missing  NaN as `undistort`
  [[nodiscard]] Eigen::Vector2d ray(const Eigen::Vector2d& pixel) const;
};

/// Returns `model.ray` of every pixel, computed a row at a time.
///
/// @shape    height_px x width_px
/// @missing  NaN as `CameraModel::undistort`
[[nodiscard]] Image<Eigen::Vector2f> rays_of(const CameraModel& model);

}  // namespace frangia
