#pragma once

#include <array>

#include <Eigen/Core>

#include "frangia/core/image.h"

namespace frangia {

/// Pinhole with Brown-Conrady distortion, as in OpenCV. A digital projector is an inverse camera
/// and uses the same model. Pixel (0, 0) is the centre of the top-left one.
struct CameraModel {
  int width_px = 0;
  int height_px = 0;
  Eigen::Vector2d focal_px = Eigen::Vector2d::Zero();
  Eigen::Vector2d principal_point_px = Eigen::Vector2d::Zero();
  std::array<double, 5> distortion{};  ///< k1 k2 p1 p2 k3

  /// Where the lens bends the normalized point (x/z, y/z) to.
  [[nodiscard]] Eigen::Vector2d distort(const Eigen::Vector2d& normalized) const;
  /// How `distort` moves with its argument.
  [[nodiscard]] Eigen::Matrix2d distort_jacobian(const Eigen::Vector2d& normalized) const;
  /// The normalized point that `distort` sends to this one, by Newton's method; NaN where the
  /// model folds back and has no inverse.
  [[nodiscard]] Eigen::Vector2d undistort(const Eigen::Vector2d& distorted) const;

  /// Pixel that sees the point, given in the lens's own frame; z > 0.
  [[nodiscard]] Eigen::Vector2d project(const Eigen::Vector3d& point) const;
  /// Normalised point (x/z, y/z) that the pixel looks at.
  [[nodiscard]] Eigen::Vector2d ray(const Eigen::Vector2d& pixel) const;
};

/// `model.ray` of every pixel.
[[nodiscard]] Image<Eigen::Vector2f> rays_of(const CameraModel& model);

}  // namespace frangia
