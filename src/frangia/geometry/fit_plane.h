#pragma once

#include <span>

#include <Eigen/Core>
#include <Eigen/Geometry>

namespace frangia {

/// The plane with the smallest sum of squared distances to the points, through their centroid.
///
/// @units    mm
/// @errors   the normal of fewer than three points, or of points on a line, is arbitrary
/// @source   eigenvector of the smallest eigenvalue of their scatter; its sign is not defined
[[nodiscard]] Eigen::Hyperplane<double, 3> fit_plane(std::span<const Eigen::Vector3d> points_mm);

}  // namespace frangia
