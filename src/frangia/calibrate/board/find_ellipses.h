#pragma once

#include <vector>

#include <Eigen/Core>

#include "frangia/core/image.h"
#include "frangia/rig/target_set.h"

namespace frangia {

/// An ellipse in an image.
struct FoundEllipse {
  Eigen::Vector2d center_px = Eigen::Vector2d::Zero();  ///< of the ellipse
  /// Half axes as columns, the longer one first, px.
  Eigen::Matrix2d axes_px = Eigen::Matrix2d::Identity();
};

/// Finds dark or light spots whose outline is an ellipse, to about a pixel.
///
/// @units    counts; pixels, (0, 0) at the center of the top-left one
/// @source   outlines of adaptive thresholds; ellipses by Fitzgibbon & Fisher 1995, as OpenCV has
/// it
[[nodiscard]] std::vector<FoundEllipse> find_ellipses(const Image<float>& counts, TargetTone tone);

}  // namespace frangia
