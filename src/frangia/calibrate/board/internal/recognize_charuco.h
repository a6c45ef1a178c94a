#pragma once

#include <optional>
#include <vector>

#include <opencv2/core.hpp>

#include "frangia/calibrate/board/find_charuco.h"
#include "frangia/calibrate/board/internal/read_markers.h"
#include "frangia/rig/board.h"

namespace frangia {

/// How many markers lie where a board has them: those that one homography maps to their squares
/// within a third of a square.
[[nodiscard]] std::size_t count_placed(const std::vector<SeenMarker>& markers, const Board& board);

/// The ChArUco board that an image shows, if it is clearly another one than the expected one.
///
/// @shape    8-bit image
/// @missing  nullopt: fewer than six markers, or the expected board
[[nodiscard]] std::optional<OtherCharuco> recognize_charuco(const cv::Mat& bytes,
                                                            const Board& expected);

}  // namespace frangia
