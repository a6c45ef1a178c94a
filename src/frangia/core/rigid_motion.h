#pragma once

#include <Eigen/Geometry>

namespace frangia {

/// The rotation R that brings points onto others best, by the sum of t f^T over their pairs, t and
/// f from the centroids: the trace of R^T `spread` is the largest.
///
/// @source   Kabsch 1976
[[nodiscard]] Eigen::Matrix3d nearest_rotation(const Eigen::Matrix3d& spread);

/// The motion of least squares that brings the points `from` onto the points `to`.
///
/// @shape    3 x n each, pairs by their column; three that are not in line determine it
[[nodiscard]] Eigen::Isometry3d rigid_motion(const Eigen::Matrix3Xd& from,
                                             const Eigen::Matrix3Xd& to);

}  // namespace frangia
