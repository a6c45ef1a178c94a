#pragma once

#include <array>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "frangia/calibrate/board/board_view.h"
#include "frangia/calibrate/board/find_charuco.h"
#include "frangia/calibrate/board/measure_sharpness.h"
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
  std::optional<OtherCharuco> other_board;  ///< ChArUco board that the image shows instead
  double blur_px = 0.0;                     ///< of the edges at the corners, as `measure_blur_px`
  ImageSharpness image;                     ///< of the whole image
  double motion_px = 0.0;  ///< of the board between patterns, as `measure_motion_px`
  std::string moved_in;    ///< the pattern in which the board is farthest away
  double likeness = 1.0;   ///< of the pattern that is least like the others: `measure_likeness`
  std::string least_like;  ///< that pattern
  double misfit = 0.0;     ///< of the worst pattern, as `measure_fringe_misfit`
  BoardPicture picture;    ///< of the board, if it was asked for
  std::string misfit_in;   ///< the pattern with that misfit
};

/// Limits of the checks before a calibration is solved.
struct PoseCheckOptions {
  /// Share of white below which the lightest squares are dark: fringes of 8-bit frames then span
  /// ten counts or fewer.
  double dim = 0.04;
  double saturated = 0.2;  ///< share of saturated pixels above which phases are lost
  /// Blur above which an image is reported as out of focus; corners then lose half their accuracy.
  double max_blur_px = 2.5;
  /// Misfit of the fringes above which the projector is reported as not linear; a display gamma of
  /// 1.3 reaches it with four frames.
  double max_misfit = 0.1;
};

/// Outcome of the checks when no fault prevents the calibration.
struct PoseChecks {
  std::vector<std::string> left_out;  ///< names of the poses that should not be used
  std::vector<std::string> warnings;  ///< one sentence each, the most likely cause of others first
};

/// Checks the poses of a board before a calibration is solved and names the first fault found. A
/// pose whose frames are swapped, whose board moved or whose phases are wrong is left out while
/// enough others remain.
///
/// @errors   Error(Input): the board has another number of corners, is not found in enough poses,
///           is saturated or dark, has no phases, moved, or its frames are swapped; rows and
///           columns of the projector are exchanged or one direction is mirrored; the phases exceed
///           the projector; all poses are parallel
PoseChecks check_board_views(std::span<const PoseCapture> poses,
                             const Board& board,
                             const Rig& known,
                             const PoseCheckOptions& options = {});

}  // namespace frangia
