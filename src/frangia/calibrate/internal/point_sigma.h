#pragma once

#include <Eigen/Core>

#include "frangia/calibrate/internal/rig_model.h"
#include "frangia/calibrate/solve/solve_rig.h"

namespace frangia {

/// How the shape of a part changes with the parameters of a rig.
struct ShapeResponse {
  /// Derivatives of the triangulated positions of nine points of each pose of the board, one below
  /// the other, with respect to the parameters of the covariance; mm. Rigid motions of all points
  /// together are removed, because they do not change a measured shape; a change of scale stays.
  Eigen::MatrixXd by_parameter;
  double distance_mm = 0.0;  ///< mean distance of the points from the camera
};

/// The response at the poses of a solution that has its covariance.
///
/// @source   linear propagation: a point is where the ray of a pixel of the reference camera meets
///           the sheet of light of one projector column, or row where rows measure depth; with a
///           label, where the rays of all cameras meet, by least squares
[[nodiscard]] ShapeResponse shape_response(const Board& board,
                                           const RigLayout& layout,
                                           const RigParameters& parameters,
                                           const RigSolution& solution);

/// `RigSolution::point_sigma_mm` by the covariance of the parameters.
[[nodiscard]] double point_sigma_mm(const ShapeResponse& shape, const Eigen::MatrixXd& covariance);

}  // namespace frangia
