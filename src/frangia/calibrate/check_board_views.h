#pragma once

#include <array>
#include <optional>
#include <span>
#include <string>

#include "frangia/calibrate/board_view.h"
#include "frangia/rig/board.h"
#include "frangia/rig/rig.h"

namespace frangia {

/// What one pose shows: the points of the board, and what its images are like.
struct PoseCapture {
  BoardView view;  ///< name and points; no point where the board is not found
  /// Brightness of the lightest squares: the 95th percentile of the image, or of the board where it
  /// is found, as a share of the white level.
  double brightness = 0.0;
  double saturated = 0.0;  ///< share of the pixels that a fringe frame saturates, likewise
  /// Inner corners of the checkerboard that the image shows, if the expected one is not found.
  std::optional<std::array<int, 2>> counted;
  int mirrored_markers = 0;  ///< of a ChArUco board that only the mirrored image shows
};

/// Limits of the checks before a calibration is solved.
struct PoseCheckOptions {
  std::size_t min_views = 3;  ///< poses with the board; Zhang's method needs three
  /// Share of white below which the lightest squares are dark: fringes of 8-bit frames then span
  /// ten counts or fewer.
  double dim = 0.04;
  double saturated = 0.2;     ///< share of saturated pixels above which phases are lost
  double min_lit = 0.5;       ///< share of a board's points with projector coordinates
  double min_tilt_deg = 5.0;  ///< largest angle between two poses; smaller: parallel
};

/// Checks the poses of a board before a calibration is solved and names the first fault found.
///
/// @errors   Error(Input): the board has another number of corners, is not found in enough poses,
///           is saturated or dark, has no phases; rows and columns of the projector are exchanged
///           or one direction is mirrored; the phases exceed the projector; all poses are parallel
void check_board_views(std::span<const PoseCapture> poses,
                       const Board& board,
                       const Rig& known,
                       const PoseCheckOptions& options = {});

}  // namespace frangia
