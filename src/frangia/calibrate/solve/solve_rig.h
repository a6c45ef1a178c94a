#pragma once

#include <array>
#include <span>
#include <string>
#include <vector>

#include <Eigen/Core>
#include <Eigen/Geometry>

#include "frangia/calibrate/board/board_view.h"
#include "frangia/core/run.h"
#include "frangia/rig/board.h"
#include "frangia/rig/rig.h"

namespace frangia {

/// Deviation of the real board from the nominal one: a printed board is scaled unevenly and bulges.
struct BoardShape {
  double aspect = 0.0;  ///< y is longer by this share than nominal, x has its nominal length
  double shear = 0.0;   ///< x grows by this share of y
  /// Height above the plane: coefficients of the Legendre products in `board_height_terms`, in mm.
  std::array<double, 12> height_mm{};
};

/// How well one set of residuals fits, all points counted.
struct ResidualSummary {
  double rms_px = 0.0;     ///< root of the mean squared distance, OpenCV's reprojection error
  double max_px = 0.0;     ///< largest distance
  std::size_t points = 0;  ///< points that were compared
  double sigma_px = 0.0;   ///< estimated standard deviation of one coordinate
};

/// How much freedom the models get.
struct RigSolveOptions {
  /// Terms beyond the first radial coefficient and one focal length enter the model only when they
  /// lower the weighted squares by more than this for each parameter: 2 is Akaike's criterion.
  double min_gain = 2.0;
  int max_iterations = 100;   ///< of the solver, for each round
  bool release_board = true;  ///< estimate the board's deviation from its nominal shape, too
};

/// How a camera was calibrated.
struct SolvedCamera {
  std::string name;   ///< as in rig.toml; empty for the reference camera
  CameraModel model;  ///< intrinsics
  Eigen::Isometry3d camera_from_rig = Eigen::Isometry3d::Identity();  ///< relative pose, mm
  ResidualSummary residuals;                                          ///< of all its pixels
  /// Of the projector pixels that it reads or, with a label, of their differences from those that
  /// the reference camera reads.
  ResidualSummary projector_residuals;
  std::vector<ResidualSummary> by_view;            ///< one a view
  std::vector<ResidualSummary> projector_by_view;  ///< one a view
  /// Observed minus predicted, point by point in the order of the views; NaN where there is no
  /// observation.
  std::vector<std::vector<Eigen::Vector2d>> residuals_px;
  /// Likewise, of the projector pixels; of the reference camera alone.
  std::vector<std::vector<Eigen::Vector2d>> projector_residuals_px{};
};

/// The calibrated part of a rig, with its uncertainty.
struct RigSolution {
  std::vector<SolvedCamera> cameras = std::vector<SolvedCamera>(1);  ///< as in the rig
  bool has_projector = true;  ///< false where the projector only labels points
  PinholeModel projector;     ///< intrinsics of the projector
  Eigen::Isometry3d projector_from_camera = Eigen::Isometry3d::Identity();  ///< relative pose, mm
  std::vector<Eigen::Isometry3d> camera_from_board;                         ///< one a view
  BoardShape board;                     ///< estimated shape of the board
  std::vector<std::string> terms;       ///< model terms that the data supports, in words
  std::vector<std::string> held;        ///< optional terms that the data does not support
  std::vector<std::string> parameters;  ///< names of the rows of `covariance`: "camera.focal_px"
  /// Of all parameters of cameras, projector and relative poses. A held term has the uncertainty
  /// that ordinary lenses leave and its correlation with the parameters that would compensate it.
  Eigen::MatrixXd covariance;
  std::vector<std::string> undetermined;  ///< parameters that the poses do not determine
  /// Standard uncertainty of the shape of a part that the uncertainty of the estimated parameters
  /// causes: length of the error vector of a triangulated point, without a rigid motion of all
  /// points; root mean square over the poses of the board.
  double point_sigma_mm = 0.0;
  double distance_mm = 0.0;  ///< mean distance of the board from the camera
  /// How far the triangulated points move, without a rigid motion, when one pose is left out; root
  /// mean square, one a view.
  std::vector<double> leave_one_out_mm;
  /// Standard uncertainty of the shape from these differences. It does not rely on the noise of
  /// corners and phases being independent, as `point_sigma_mm` does.
  double spread_mm = 0.0;
  int iterations = 0;  ///< of the solver, all rounds together

  [[nodiscard]] const SolvedCamera& reference() const { return cameras.front(); }  ///< camera 0
};

/// Estimates all cameras, the projector and their relative poses from views of a board in one
/// bundle adjustment over all views. A projector that is a label is not estimated: the pixels that
/// two cameras read at one point must agree. The order of the distortion models and of the board's
/// shape is chosen by evidence; the standard deviations of corners and phases are scaled to the
/// residuals. Of `known` the sizes are used, and focal lengths and principal points as starting
/// values where they are finite.
///
/// @units    mm, px, rad
/// @missing  points whose `projector_px` is NaN enter by their camera pixel alone
/// @errors   Error(Input) for fewer than three views, in all or of a further camera, none with a
///           projector pixel, a label without a further camera, or an angular projector;
///           Error(Numeric) when the adjustment fails
/// @source   Zhang 2000, A Flexible New Technique for Camera Calibration; Zhang & Huang 2006, Novel
///           method for structured light system calibration; Akaike 1974 for the order of the model
[[nodiscard]] RigSolution solve_rig(const Board& board,
                                    std::span<const BoardView> views,
                                    const Rig& known,
                                    const RigSolveOptions& options = {},
                                    const Run& run = {});

}  // namespace frangia
