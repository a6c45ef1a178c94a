#pragma once

#include <span>
#include <vector>

#include <Eigen/Geometry>

#include "frangia/uncertainty/pose_uncertainty.h"

namespace frangia {

/// The same place of a part on its scan and on its reference.
struct PointPair {
  Eigen::Vector3d scan_mm = Eigen::Vector3d::Zero();       ///< in the frame of the scan
  Eigen::Vector3d reference_mm = Eigen::Vector3d::Zero();  ///< in the frame of the reference
};

/// The result of an alignment to pairs of points.
struct PointAlignment {
  Eigen::Isometry3d reference_from_mesh = Eigen::Isometry3d::Identity();  ///< the pose
  std::vector<double> distances_mm;  ///< of the points of each pair, after the motion
  /// By the distances, with Student's factor: of three pairs it is rough.
  PoseUncertainty uncertainty;
};

/// Finds the rigid motion that brings the points of the scan nearest to those of the reference,
/// by least squares.
///
/// @units    mm
/// @errors   Error(Input) for fewer than three pairs, for points on one line, for a scale that
///           differs, and for a pair that does not match the others, which is named by its number
/// @source   Umeyama 1991; covariance by the residuals, with 3n - 6 degrees of freedom
[[nodiscard]] PointAlignment align_to_points(std::span<const PointPair> pairs);

}  // namespace frangia
