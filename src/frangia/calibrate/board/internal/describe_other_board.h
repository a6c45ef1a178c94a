#pragma once

#include <span>
#include <string>

#include "frangia/calibrate/board/check_board_views.h"

namespace frangia {

/// Says which ChArUco board most of the poses show in place of the expected one, and what to do;
/// empty when fewer than two show one, or fewer than half of those without the board.
[[nodiscard]] std::string describe_other_board(std::span<const PoseCapture> poses,
                                               const Board& board);

}  // namespace frangia
