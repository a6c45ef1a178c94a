#pragma once

#include <cstdint>
#include <filesystem>

#include "frangia/core/run.h"
#include "frangia/dataset/scan_folder.h"
#include "frangia/geometry/mesh.h"
#include "frangia/rig/board.h"
#include "frangia/rig/rig.h"
#include "frangia/simulate/default_patterns.h"
#include "frangia/simulate/simulate_options.h"

namespace frangia {

/// Captures of a board for calibration.
struct CalibrationPlan {
  std::filesystem::path folder;  ///< scan folder to write
  Rig rig;                       ///< the true rig, with a digital projector
  /// `square_mm` 0 chooses the largest board that leaves room to tilt and move it.
  Board board{.kind = BoardKind::Checkerboard, .columns = 10, .rows = 7};
  int poses = 12;  ///< number of views
  /// The board stands on the turntable, which turns from view to view, so that the captures serve
  /// `calibrate turntable`.
  bool on_turntable = false;
  double turn_rad = 1.0;      ///< from the first to the last view, with `on_turntable`
  double max_tilt_rad = 0.6;  ///< of the board against the plane across the camera's axis
  PatternPlan patterns;       ///< of the vertical fringes; horizontal ones are added likewise
};

/// A board and the poses in which it is captured.
struct BoardPoses {
  Scan scan;   ///< one setup for each pose, with its part pose; its rig is the true one
  Mesh plate;  ///< whose face at z = 0 shows the board
};

/// Chooses poses in which all cameras and the projector see the whole board.
///
/// @errors   Error(Input) when the projector is angular or no pose shows the whole board
[[nodiscard]] BoardPoses plan_board_poses(const CalibrationPlan& plan, std::uint64_t seed);

/// Renders poses of a printed board, as all cameras see them, into a scan folder: fringes in both
/// directions and one frame of white light. Returns the scan as written.
///
/// rig.toml holds the sizes of cameras and projector only. The true rig is written to
/// truth-rig.toml, the true poses to truth-setups.toml.
/// @errors   Error(Input) when the projector is angular, when no pose shows the whole board to
///           camera and projector, or as `simulate_scan`
[[nodiscard]] Scan simulate_calibration(const CalibrationPlan& plan,
                                        const SimulateOptions& options = {},
                                        const Run& run = {});

}  // namespace frangia
