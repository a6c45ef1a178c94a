#pragma once

#include <span>

#include <Eigen/Core>

namespace frangia {

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
