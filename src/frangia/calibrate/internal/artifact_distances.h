#pragma once

#include <cstddef>
#include <vector>

#include <Eigen/Core>

#include "frangia/calibrate/artifact/calibrate_artifacts.h"

namespace frangia {

/// Signed distance of a measured point from the artifact on which it lies.
struct ArtifactDistance {
  Eigen::Vector2d camera_px = Eigen::Vector2d::Zero();
  double distance_mm = 0.0;  ///< above 0 outside of a ball, or beyond a plate along its normal
};

/// The distances of the sites of one view of a capture, triangulated with the calibrated rig, from
/// the artifact as it was found, turned by the angle of the table and its error.
///
/// @missing  a site that is not measured is left out
[[nodiscard]] std::vector<ArtifactDistance> artifact_distances(const ArtifactCalibration& result,
                                                               std::size_t capture,
                                                               std::size_t view);

/// Root mean square; 0 without a distance.
[[nodiscard]] double rms_mm(const std::vector<ArtifactDistance>& distances);

}  // namespace frangia
