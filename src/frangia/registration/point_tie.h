#pragma once

#include <cstddef>

#include <Eigen/Core>

namespace frangia {

/// A point of the part that two views measured, such as the centre of a target.
///
/// @units    mm, rig frame of each view
struct PointTie {
  std::size_t from = 0;                               ///< view
  std::size_t to = 0;                                 ///< another view
  Eigen::Vector3d from_mm = Eigen::Vector3d::Zero();  ///< as the view `from` measured it
  Eigen::Vector3d to_mm = Eigen::Vector3d::Zero();    ///< as the view `to` measured it
  Eigen::Matrix3d from_covariance_mm2 = Eigen::Matrix3d::Zero();  ///< of `from_mm`
  Eigen::Matrix3d to_covariance_mm2 = Eigen::Matrix3d::Zero();    ///< of `to_mm`
  /// 2 / k for each pair of k views of one point: all pairs together then say what k points do.
  double share = 1.0;
};

}  // namespace frangia
