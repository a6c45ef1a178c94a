#pragma once

#include <vector>

#include <Eigen/Core>

#include "frangia/calibrate/board/board_view.h"
#include "frangia/calibrate/internal/rig_model.h"
#include "frangia/calibrate/solve/calibrate_rig.h"
#include "frangia/calibrate/solve/solve_rig.h"
#include "frangia/core/run.h"
#include "frangia/dataset/scan_folder.h"

namespace frangia {

/// Fails where the poses do not determine a parameter or contradict each other.
void check_solution(const RigSolution& solution,
                    const std::vector<BoardView>& views,
                    double max_rms_px);

/// Names a wrong square where rig.toml states the distance of two devices beforehand.
void warn_of_scale(const Scan& scan, const RigSolution& solution, double max_error, const Run& run);

/// The views whose reprojection error is far above the median of all views.
[[nodiscard]] std::vector<std::size_t> outlier_views(const std::vector<ResidualSummary>& by_view);

/// Names the poses whose reprojection error is far above that of the others.
void warn_of_outliers(const std::vector<BoardView>& views,
                      const RigSolution& solution,
                      const Run& run);

/// Inverse of the normal matrix over the directions that the data determines.
struct NormalInverse {
  Eigen::MatrixXd covariance;
  Eigen::VectorXd open;  ///< share of each parameter that lies in directions left open, 0 to 1
};

/// Inverts a normal matrix; in parameters scaled to unit diagonal, a direction whose eigenvalue is
/// below `least` of the largest is open and left out of the covariance.
[[nodiscard]] NormalInverse invert_normal(const Eigen::MatrixXd& normal, double least);

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
