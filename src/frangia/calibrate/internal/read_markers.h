#pragma once

#include <array>
#include <vector>

#include <opencv2/core.hpp>

#include "frangia/rig/board.h"

namespace frangia {

/// A marker of a board as an image shows it.
struct SeenMarker {
  int id = 0;
  std::array<cv::Point2f, 4> corners;  ///< clockwise from the top left of the printed marker
};

/// Reads the markers of a ChArUco board. `mirrored` reads the markers of the mirrored board.
///
/// @shape    8-bit image
/// @source   Garrido-Jurado et al. 2014: quadrangles of an adaptive threshold, rectified, compared
///           with the dictionary by Hamming distance
[[nodiscard]] std::vector<SeenMarker> read_markers(const cv::Mat& bytes,
                                                   const Board& board,
                                                   bool mirrored = false);

}  // namespace frangia
