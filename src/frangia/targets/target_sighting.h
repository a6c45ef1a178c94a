#pragma once

#include <Eigen/Core>

namespace frangia {

/// A target as one view measured it.
///
/// @units    mm, rig frame of the view's camera; px
struct TargetSighting {
  int code = -1;                                             ///< of a coded target; -1: it has none
  Eigen::Vector2d center_px = Eigen::Vector2d::Zero();       ///< image of the centre of the disc
  Eigen::Vector3d center_mm = Eigen::Vector3d::Zero();       ///< on the plane of the target
  Eigen::Matrix3d covariance_mm2 = Eigen::Matrix3d::Zero();  ///< of `center_mm`
  Eigen::Vector3d normal = Eigen::Vector3d::Zero();  ///< unit, of its plane, towards the camera
  double size_ratio = 1.0;                           ///< measured over stated diameter or side
  double blur_px = 0.0;                              ///< standard deviation of the blur of its edge
};

}  // namespace frangia
