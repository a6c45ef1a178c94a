#pragma once

#include <limits>

#include <Eigen/Core>

namespace frangia {

/// Where the light comes from that a camera pixel sees, by the phase of each fringe direction:
/// pixels of a projector or screen, or the nominal angle psi of an angular projector in rad.
struct LightSite {
  Eigen::Vector2d camera_px = Eigen::Vector2d::Zero();  ///< in the camera image
  /// By vertical and by horizontal fringes; NaN where a direction is not measured.
  Eigen::Vector2d light = Eigen::Vector2d::Constant(std::numeric_limits<double>::quiet_NaN());
  Eigen::Vector2d sigma = Eigen::Vector2d::Zero();  ///< standard deviation of `light`
  /// Derivative of `light` with respect to the camera pixel, on the surface around the site.
  Eigen::Matrix2d by_camera = Eigen::Matrix2d::Zero();
};

}  // namespace frangia
