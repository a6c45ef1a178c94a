#pragma once

#include <array>
#include <span>
#include <string>
#include <vector>

#include <opencv2/core.hpp>

#include "frangia/calibrate/board/check_board_views.h"
#include "frangia/rig/aruco_dictionary.h"
#include "frangia/rig/board.h"

namespace frangia {

/// A marker of a board as an image shows it.
struct SeenMarker {
  int id = 0;
  std::array<cv::Point2f, 4> corners;  ///< clockwise from the top left of the printed marker
};

/// Reads the markers of a ChArUco board; their ids count from its first one. `mirrored` reads the
/// markers of the mirrored board.
///
/// @shape    8-bit image
/// @source   Garrido-Jurado et al. 2014: quadrangles of an adaptive threshold, rectified, compared
///           with the dictionary by Hamming distance
[[nodiscard]] std::vector<SeenMarker> read_markers(const cv::Mat& bytes,
                                                   const Board& board,
                                                   bool mirrored = false);

/// Reads the markers of a dictionary, also several with one id.
///
/// @shape    8-bit image
[[nodiscard]] std::vector<SeenMarker> read_all_markers(const cv::Mat& bytes,
                                                       const ArucoDictionary& dictionary);

/// The markers of one size of cells that most of an image shows.
struct AnyMarkers {
  int cells = 0;
  bool inverted = false;            ///< white where they should be black
  bool mirrored = false;            ///< as in a mirror
  std::vector<SeenMarker> markers;  ///< with their ids in the dictionary of 250 markers
};

/// Reads the markers of all dictionaries, also inverted and mirrored ones, and returns the kind of
/// which most are seen.
///
/// @shape    8-bit image
[[nodiscard]] AnyMarkers read_any_markers(const cv::Mat& bytes);

/// Says which ChArUco board most of the poses show in place of the expected one, and what to do;
/// empty when fewer than two show one, or fewer than half of those without the board.
[[nodiscard]] std::string describe_other_board(std::span<const PoseCapture> poses,
                                               const Board& board);

}  // namespace frangia
