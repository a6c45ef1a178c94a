#pragma once

#include <optional>
#include <span>
#include <vector>

#include <Eigen/Core>

#include "frangia/core/image.h"
#include "frangia/rig/board.h"

namespace frangia {

/// Finds the centers of a rectangular grid of dark circles on a bright ground.
///
/// @shape    `counts` w x h; the centers in the order of `board_points_mm`
/// @units    counts; pixels, (0, 0) at the center of the top-left one
/// @missing  nothing when the grid is not seen whole
/// @source   OpenCV's findCirclesGrid with clustering, then `refine_circle`
[[nodiscard]] std::optional<std::vector<Eigen::Vector2d>> find_circles(const Image<float>& counts,
                                                                       const Board& board);

/// The same centers in another image of the same pose: `centers_px` are those of all circles
/// nearby, as `find_circles` gives them.
[[nodiscard]] std::vector<Eigen::Vector2d> find_circles_near(
    const Image<float>& counts, const Board& board, std::span<const Eigen::Vector2d> centers_px);

}  // namespace frangia
