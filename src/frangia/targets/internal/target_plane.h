#pragma once

#include <vector>

#include <Eigen/Core>

#include "frangia/core/image.h"
#include "frangia/range/range_grid.h"

namespace frangia {

/// A plane through measured points.
///
/// @units    mm, rig frame
struct TargetPlane {
  Eigen::Vector3d normal = Eigen::Vector3d::UnitZ();    ///< unit, towards the camera
  Eigen::Vector3d center_mm = Eigen::Vector3d::Zero();  ///< weighted mean of its points
  /// Of the distance of the plane at `center_mm`, and of its slopes along the columns of `sides`.
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
  Eigen::Matrix<double, 3, 2> sides = Eigen::Matrix<double, 3, 2>::Zero();  ///< unit, in the plane
  std::size_t points = 0;

  /// Where the ray of a pixel meets the plane.
  [[nodiscard]] Eigen::Vector3d meet(const Eigen::Vector2d& ray) const {
    const Eigen::Vector3d direction(ray.x(), ray.y(), 1.0);
    return direction * (normal.dot(center_mm) / normal.dot(direction));
  }
  /// Variance of the distance of the plane from a point on it.
  [[nodiscard]] double variance_mm2(const Eigen::Vector3d& point_mm) const;
};

/// Finds the planes of the points around a spot of an image, those with most points first. Points
/// near the edge of the spot are left out: the fringes of both sides mix there.
///
/// @shape    `axes_px`: half axes of the spot as columns
/// @missing  empty where there are too few points
[[nodiscard]] std::vector<TargetPlane> find_target_planes(const RangeGrid& range,
                                                          const Image<Eigen::Vector2f>& rays,
                                                          const Eigen::Vector2d& center_px,
                                                          const Eigen::Matrix2d& axes_px);

}  // namespace frangia
