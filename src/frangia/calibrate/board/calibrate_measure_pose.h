#pragma once

#include <span>
#include <string>

#include "frangia/calibrate/board/check_board_views.h"
#include "frangia/calibrate/board/fit_phase_at.h"
#include "frangia/core/run.h"
#include "frangia/decode/decode_view.h"
#include "frangia/frames/frame_stack.h"
#include "frangia/rig/board.h"
#include "frangia/rig/rig.h"

namespace frangia {

/// How one pose of a board is measured.
struct PoseOptions {
  DecodeOptions decode;  ///< from frames to absolute phase
  PhaseFitOptions fit;   ///< phase at the points of the board
  /// Corners of a ChArUco board below which it counts as not found: two rows of four fix a pose.
  std::size_t min_points = 8;
  bool keep_picture = false;  ///< keep a small picture of the board
};

/// Measures one pose: the points of the board in the camera image and, from the phases of both
/// directions, in the projector.
///
/// @shape    `stacks` as read_frames returns them
/// @missing  no points where the board is not found; NaN where a phase is not measured
[[nodiscard]] PoseCapture calibrate_measure_pose(std::span<const FrameStack> stacks,
                                                 const Board& board,
                                                 const Rig& known,
                                                 const std::string& name,
                                                 const PoseOptions& options = {},
                                                 const Run& run = {});

}  // namespace frangia
