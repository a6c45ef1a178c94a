#pragma once

#include <optional>

#include <Eigen/Core>

#include "frangia/core/image.h"
#include "frangia/targets/internal/target_plane.h"

namespace frangia {

/// The outline of what is printed, on its plane.
struct TargetOutline {
  bool square = false;    ///< the outer edge of a marker; otherwise a disc
  double size_mm = 0.0;   ///< diameter or side
  double outer_mm = 0.0;  ///< width of the ground of even tone around it
  double inner_mm = 0.0;  ///< width of the even tone within it
};

/// Where an outline is on its plane.
struct OutlineFit {
  Eigen::Vector3d center_mm = Eigen::Vector3d::Zero();
  /// Of the centre, along the columns of `TargetPlane::sides`.
  Eigen::Matrix2d covariance_mm2 = Eigen::Matrix2d::Zero();
  double size_ratio = 1.0;  ///< measured over stated size
  double blur_px = 0.0;     ///< standard deviation
  double contrast = 0.0;    ///< inside minus ground, counts
  double misfit = 0.0;      ///< residual over contrast, rms
};

/// Fits the image of an outline on a plane to the counts of an image: its centre, size and turn on
/// the plane, the blur, and even light from both tones. As the outline is projected and blurred
/// before it is compared, neither the perspective nor the blur moves its centre.
///
/// @shape    `turn_rad`: direction of one side of a square against the first of `plane.sides`
/// @missing  nothing where the image ends, or the fit leaves its start
[[nodiscard]] std::optional<OutlineFit> refine_target(const Image<float>& counts,
                                                      const Image<Eigen::Vector2f>& rays,
                                                      const TargetPlane& plane,
                                                      const TargetOutline& outline,
                                                      const Eigen::Vector3d& start_mm,
                                                      double turn_rad = 0.0);

}  // namespace frangia
