#pragma once

#include <string>
#include <vector>

#include "frangia/calibrate/board/calibrate_measure_pose.h"
#include "frangia/calibrate/board/check_board_views.h"
#include "frangia/calibrate/solve/solve_rig.h"
#include "frangia/core/run.h"
#include "frangia/dataset/scan_folder.h"
#include "frangia/rig/rig.h"

namespace frangia {

/// Options of a calibration from captured poses of a board.
struct CalibrateRigOptions {
  PoseOptions pose;        ///< how each pose is measured
  PoseCheckOptions check;  ///< limits of the checks before solving
  RigSolveOptions solve;   ///< bundle adjustment and order of the models
  /// Relative difference of the baseline from that of rig.toml above which the board's square is
  /// questioned; a baseline measured by hand is this accurate.
  double max_scale_error = 0.02;
};

/// A calibrated rig and how it was found.
struct RigCalibration {
  Rig rig;                                 ///< calibrated, with `calibration` filled
  RigSolution solution;                    ///< parameters, residuals and covariance
  std::vector<BoardView> views;            ///< poses that were used
  std::vector<BoardPicture> pictures;      ///< of the views, with `PoseOptions::keep_picture`
  std::vector<std::string> without_board;  ///< folders of the views without the board
  std::vector<std::string> left_out;  ///< folders of the views with a fault, which are not used
};

/// A word for the accuracy that a calibration permits, from the larger of `point_sigma_mm` and
/// `spread_mm` relative to the distance: "excellent" up to 1 / 20 000, "good" up to 1 / 5000,
/// "usable" up to 1 / 1000, else "poor".
[[nodiscard]] std::string calibration_grade(const RigSolution& solution);

/// The same from an uncertainty and the distance at which it holds.
[[nodiscard]] std::string calibration_grade(double sigma_mm, double distance_mm);

/// Calibrates camera, projector and their relative pose from a scan whose views are poses of a
/// board, with fringes in both directions.
///
/// `scan` may be read with `RigContent::StartValues`.
/// @errors   Error(Input) with the first fault found: no `[board]`, an angular projector, a fringe
///           direction without absolute phase, or as `check_board_views`, or poses that do not
///           determine a parameter or contradict each other; Error(Numeric) when the adjustment
///           fails
[[nodiscard]] RigCalibration calibrate_rig(const Scan& scan,
                                           const CalibrateRigOptions& options = {},
                                           const Run& run = {});

}  // namespace frangia
