#pragma once

#include <vector>

#include "frangia/calibrate/board_view.h"
#include "frangia/core/image.h"
#include "frangia/rig/board.h"

namespace frangia {

/// What an image shows of a ChArUco board.
struct CharucoSight {
  std::vector<BoardPoint> points;  ///< inner corners near markers that were read, by index
  int markers = 0;                 ///< of the board that were read
  int mirrored_markers = 0;        ///< of the board that only the mirrored image shows
};

/// Finds the inner corners of a ChArUco board, of which a part may be hidden or outside of the
/// image. Markers tell which corners are seen; the corners are refined to subpixels.
///
/// @shape    image of the mean intensity
/// @units    px
/// @missing  corners without a marker nearby are left out
/// @errors   Error(Input) as `check_board`
/// @source   Garrido-Jurado et al. 2014 for the markers; corners as `find_checkerboard`
[[nodiscard]] CharucoSight find_charuco(const Image<float>& counts, const Board& board);

}  // namespace frangia
