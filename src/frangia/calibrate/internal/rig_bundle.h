#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include <Eigen/Core>

#include "frangia/calibrate/board/board_view.h"
#include "frangia/calibrate/internal/rig_model.h"
#include "frangia/calibrate/internal/rig_residuals.h"
#include "frangia/core/run.h"
#include "frangia/rig/board.h"

namespace frangia {

/// One coordinate pair of the measurements, as the adjustment has it.
struct RigObservation {
  std::size_t view = 0;
  std::size_t point = 0;  ///< of the camera in the view
  BoardSite site;
  std::size_t camera = 0;         ///< 0: the reference camera, then the further ones
  bool by_projector = false;      ///< the projector pixel that the camera reads
  bool is_label = false;          ///< its difference from the one that the reference camera reads
  double circle_radius_mm = 0.0;  ///< of a board of circles
  Eigen::Vector2d pixel = Eigen::Vector2d::Zero();
  Eigen::Vector2d sigma_px = Eigen::Vector2d::Ones();
  PhaseReading reading{};    ///< of the camera, by_projector only
  PhaseReading reference{};  ///< of the reference camera, is_label only

  /// The scale of its standard deviation.
  [[nodiscard]] double scale(const RigNoise& noise) const {
    return (by_projector ? noise.projector : noise.camera)[camera];
  }
};

/// All observations of all views by all cameras; those of the projector where it was measured. With
/// a label, these are the differences of what two cameras read.
[[nodiscard]] std::vector<RigObservation> observations_of(const Board& board,
                                                          std::span<const BoardView> views,
                                                          bool has_projector = true);

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
