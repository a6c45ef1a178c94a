#pragma once

#include <optional>
#include <string>
#include <vector>

#include "frangia/calibrate/board/board_view.h"
#include "frangia/core/image.h"
#include "frangia/rig/board.h"

namespace frangia {

/// A ChArUco board that an image shows in place of the expected one.
struct OtherCharuco {
  std::string dictionary;      ///< the smallest that has its markers
  int markers = 0;             ///< that were read
  int first_id = 0;            ///< the lowest id that was read
  int last_id = 0;             ///< the highest id that was read
  bool inverted = false;       ///< white where it should be black
  bool mirrored = false;       ///< as in a mirror
  int columns = 0;             ///< inner corners along x; 0: as expected, or not to be told
  int rows = 0;                ///< inner corners along y up to the last marker
  bool legacy_layout = false;  ///< as `Board::legacy_layout`
  int layout_first_id = 0;     ///< id of the first marker in that layout
};

/// What an image shows of a ChArUco board.
struct CharucoSight {
  std::vector<BoardPoint> points;     ///< inner corners near markers that were read, by index
  int markers = 0;                    ///< of the board that were read
  int mirrored_markers = 0;           ///< of the board that only the mirrored image shows
  std::optional<OtherCharuco> other;  ///< the board that it shows instead; `points` is then empty
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

/// The ChArUco board that an image shows where a board of another kind is expected.
///
/// @missing  nullopt: fewer than six markers
[[nodiscard]] std::optional<OtherCharuco> find_other_charuco(const Image<float>& counts,
                                                             const Board& board);

}  // namespace frangia
