#pragma once

#include <span>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "frangia/calibrate/internal/rig_bundle.h"

namespace frangia {

/// The covariance of the parameters of a rig.
struct SolvedCovariance {
  Eigen::MatrixXd covariance;
  std::vector<std::string> undetermined;  ///< parameters that the data do not determine
};

/// The covariance of cameras, projector and relative poses, with the poses and the board's shape
/// marginalized. Terms of the lenses that are held have the uncertainty that ordinary lenses leave,
/// so that it enters the parameters that would compensate them.
///
/// @shape    `names` are those of the first parameters of the layout, whose covariance is returned
/// @units    focal lengths and principal points px, rotation rad, translation mm
/// @missing  a parameter that is not determined has an infinite variance
/// @source   inverse of the normal equations; a direction whose eigenvalue is below 1e-12 of the
///           largest, in parameters scaled to unit diagonal, counts as not determined
[[nodiscard]] SolvedCovariance covariance_of(std::span<const RigObservation> observations,
                                             const RigFreedom& freedom,
                                             const RigNoise& noise,
                                             const RigParameters& parameters,
                                             const std::vector<std::string>& names);

}  // namespace frangia
