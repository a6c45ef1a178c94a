#pragma once

#include <span>
#include <vector>

#include <Eigen/Core>

#include "frangia/calibrate/internal/rig_model.h"
#include "frangia/calibrate/internal/rig_observations.h"
#include "frangia/core/run.h"

namespace frangia {

/// Predicted minus observed pixel. Of a label, the difference of the pixels that both cameras read,
/// without the part that the errors of the cameras' pixels cause.
[[nodiscard]] Eigen::Vector2d residual_of(const RigObservation& observation,
                                          const RigParameters& parameters);

/// The residual that the adjustment minimizes: that of the projector without the part that the
/// error of the camera's pixel causes, so that the residuals of camera and projector are
/// independent.
[[nodiscard]] Eigen::Vector2d independent_residual_of(const RigObservation& observation,
                                                      const RigParameters& parameters);

/// Weight of a residual of a given length in standard deviations, by Huber's loss.
[[nodiscard]] double robust_weight(double sigmas);

struct RigBundleResult {
  int iterations = 0;
  bool usable = false;  ///< the solver ended at a state that is not worse than the start
};

/// Minimizes the weighted squares of all residuals over the free parameters, in place.
///
/// @errors   Error(Cancelled) when a stop is requested
/// @source   Levenberg-Marquardt of Ceres; Huber's loss beyond 3 sigma
RigBundleResult adjust_rig(std::span<const RigObservation> observations,
                           const RigFreedom& freedom,
                           const RigNoise& noise,
                           int max_iterations,
                           RigParameters& parameters,
                           const Run& run);

/// The weighted residuals near some parameters.
struct RigLinearization {
  Eigen::MatrixXd jacobian;  ///< residuals x all parameters of the layout, then the poses
  Eigen::VectorXd residuals;
};

/// Linearizes the weighted residuals, with the weights of the robust loss.
[[nodiscard]] RigLinearization linearize_rig(std::span<const RigObservation> observations,
                                             const RigLayout& layout,
                                             const RigNoise& noise,
                                             const RigParameters& parameters);

/// Columns of the linearization that a model estimates, poses included.
[[nodiscard]] std::vector<Eigen::Index> free_columns(const RigFreedom& freedom,
                                                     Eigen::Index columns);

}  // namespace frangia
