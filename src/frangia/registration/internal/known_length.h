#pragma once

#include <Eigen/Core>

#include "frangia/registration/internal/drift_bundle.h"
#include "frangia/registration/refine_rig.h"
#include "frangia/rig/rig.h"

namespace frangia {

/// What the known distance of two balls says about a rig.
struct KnownLength {
  double scale = 1.0;           ///< known over measured distance
  Eigen::MatrixXd information;  ///< about the changes of the rig, in units of their prior
};

/// Finds the ball bar on the surfaces of all views, in the state of the bundle.
///
/// @errors   Error(Input) when there are no two balls, or their distance differs from the known one
///           by more than `max_scale_error`
[[nodiscard]] KnownLength measure_known_length(const DriftBundle& bundle,
                                               const RefineRigOptions& options);

/// Multiplies all lengths of a rig, so that all that it measures grows alike.
void scale_rig(Rig& rig, double factor);

}  // namespace frangia
