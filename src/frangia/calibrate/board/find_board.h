#pragma once

#include <vector>

#include "frangia/calibrate/board/board_view.h"
#include "frangia/core/image.h"
#include "frangia/rig/board.h"

namespace frangia {

/// Finds the points of a board in an image; `BoardPoint::camera_px` is set, nothing of the
/// projector.
///
/// @shape    all points of the board in the order of `board_points_mm`; empty when the board is not
///           seen whole
/// @units    counts; pixels, (0, 0) at the center of the top-left one
[[nodiscard]] std::vector<BoardPoint> find_board(const Image<float>& counts, const Board& board);

}  // namespace frangia
