#pragma once

#include <array>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include <Eigen/Core>

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

/// A square marker of a dictionary in an image.
struct FoundMarker {
  int code = 0;                               ///< number in the dictionary
  std::array<Eigen::Vector2d, 4> corners_px;  ///< clockwise from the top left of the printed marker
};

/// Finds the markers of a dictionary of OpenCV's ArUco, also several with one code. The corners are
/// those of whole pixels.
///
/// @units    counts; pixels, (0, 0) at the center of the top-left one
/// @errors   Error(Input) for a dictionary that does not exist
[[nodiscard]] std::vector<FoundMarker> find_markers(const Image<float>& counts,
                                                    const std::string& dictionary);

/// Counts the inner corners of the largest checkerboard in an image, along its two sides.
///
/// It serves messages: it states what a picture shows when the expected board is not found. A board
/// that the image cuts off counts with the corners that are seen.
/// @units    counts
/// @missing  nothing when the image shows no checkerboard of 4 x 3 corners or more
/// @source   Duda & Frese 2018; OpenCV
[[nodiscard]] std::optional<std::array<int, 2>> count_corners(const Image<float>& counts);

}  // namespace frangia
