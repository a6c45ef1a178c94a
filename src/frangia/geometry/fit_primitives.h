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

/// A sphere fitted to points.
struct Sphere {
  Eigen::Vector3d center_mm = Eigen::Vector3d::Zero();  ///< center, in the frame of the points
  double radius_mm = 0.0;                               ///< radius of the best fit
  double rms_mm = 0.0;  ///< RMS distance of the points from the sphere
};

/// Fits the sphere with the smallest sum of squared distances to the points.
///
/// @units    mm
/// @errors   Error(Input) for fewer than four points; Error(Numeric) when they lie in a plane
/// @source   algebraic start, then Gauss-Newton on the geometric distance
[[nodiscard]] Sphere fit_sphere(std::span<const Eigen::Vector3d> points_mm);

}  // namespace frangia
