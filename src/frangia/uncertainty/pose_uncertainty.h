#pragma once

#include <algorithm>
#include <cmath>

#include <Eigen/Geometry>

namespace frangia {

/// The uncertainty of the pose of a part, and what it does to its points.
struct PoseUncertainty {
  /// Covariance of a rotation about the center (rad, first three) and of a translation (mm). Zero
  /// along directions that are held because the shape does not determine them.
  Eigen::Matrix<double, 6, 6> covariance = Eigen::Matrix<double, 6, 6>::Zero();
  Eigen::Vector3d center_mm = Eigen::Vector3d::Zero();  ///< of the rotations

  /// Returns the standard uncertainty of a point along a unit normal.
  ///
  /// @units    mm
  [[nodiscard]] double along(const Eigen::Vector3d& point_mm, const Eigen::Vector3d& normal) const {
    Eigen::Matrix<double, 6, 1> row;
    row << (point_mm - center_mm).cross(normal), normal;
    return std::sqrt(std::max(0.0, row.dot(covariance * row)));
  }
};

}  // namespace frangia
