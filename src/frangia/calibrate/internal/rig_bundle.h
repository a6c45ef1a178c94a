#pragma once

#include <span>
#include <vector>

#include <Eigen/Core>

#include "frangia/calibrate/board_view.h"
#include "frangia/calibrate/internal/rig_model.h"
#include "frangia/core/run.h"
#include "frangia/rig/board.h"

namespace frangia {

/// One coordinate pair of the measurements, as the adjustment has it.
struct RigObservation {
  std::size_t view = 0;
  std::size_t point = 0;  ///< in the view
  BoardSite site;
  bool by_projector = false;
  double circle_radius_mm = 0.0;  ///< of a board of circles
  Eigen::Vector2d pixel = Eigen::Vector2d::Zero();
  Eigen::Vector2d sigma_px = Eigen::Vector2d::Ones();
  Eigen::Vector2d camera_px = Eigen::Vector2d::Zero();  ///< of the point, by_projector only
  Eigen::Matrix2d projector_by_camera = Eigen::Matrix2d::Zero();  ///< see BoardPoint
};

/// Standard deviations by which those of the observations are multiplied.
struct RigNoise {
  double camera = 1.0;
  double projector = 1.0;
};

/// All observations of all views; those of the projector where it was measured.
[[nodiscard]] std::vector<RigObservation> observations_of(const Board& board,
                                                          std::span<const BoardView> views);

/// Predicted minus observed pixel.
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
  Eigen::MatrixXd jacobian;  ///< residuals x free parameters
  Eigen::VectorXd residuals;
};

/// Linearizes the weighted residuals by the free parameters of camera, projector, their relative
/// pose, the board and then the poses, with the weights of the robust loss.
[[nodiscard]] RigLinearization linearize_rig(std::span<const RigObservation> observations,
                                             const RigFreedom& freedom,
                                             const RigNoise& noise,
                                             const RigParameters& parameters);

}  // namespace frangia
