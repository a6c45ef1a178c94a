#pragma once

#include <optional>
#include <vector>

#include <Eigen/Core>

#include "frangia/core/image.h"
#include "frangia/rig/board.h"

namespace frangia {

/// Finds the inner corners of a checkerboard in an image and refines them to subpixel.
///
/// The board is searched at several scales, with and without local equalization of the contrast, so
/// that a dark background, shadows, vignetting and a printer's dither do not matter.
/// @shape    `counts` w x h; the corners in the order of `board_points_mm`
/// @units    counts; pixels, (0, 0) at the center of the top-left one
/// @missing  nothing when the board is not seen whole
/// @source   Duda & Frese 2018 for the search; Foerstner & Guelch 1987 for the refinement; OpenCV
[[nodiscard]] std::optional<std::vector<Eigen::Vector2d>> find_checkerboard(
    const Image<float>& counts, const Board& board);

}  // namespace frangia
