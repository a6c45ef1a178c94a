#pragma once

#include <string>
#include <vector>

#include "frangia/calibrate/board/calibrate_measure_pose.h"
#include "frangia/calibrate/board/check_board_views.h"
#include "frangia/calibrate/solve/solve_turntable.h"
#include "frangia/core/run.h"
#include "frangia/dataset/scan_folder.h"
#include "frangia/rig/rig.h"

namespace frangia {

/// A rig with the axis of its turntable and how it was found.
struct TurntableCalibration {
  Rig rig;                                 ///< the calibrated rig with the turntable found
  TurntableSolution solution;              ///< axis, residuals and standard deviations
  std::vector<BoardView> views;            ///< views that were used
  std::vector<std::string> without_board;  ///< folders of the views without the board
};

/// Finds the axis of the turntable from a scan whose views, with their angles, show a board that
/// stands on the table.
///
/// `rig` is calibrated; of `scan` the views, patterns and board are used.
/// @errors   Error(Input) when scan.toml has no `[board]`, or as `solve_turntable`; or when the
///           reprojection error exceeds `max_rms_px`, because the board or the camera moved or the
///           angles are wrong
[[nodiscard]] TurntableCalibration calibrate_turntable(const Scan& scan,
                                                       const Rig& rig,
                                                       const PoseOptions& options = {},
                                                       double max_rms_px = 5.0,
                                                       const Run& run = {});

}  // namespace frangia
