#pragma once

#include <array>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "frangia/core/image.h"

namespace frangia {

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

}  // namespace frangia
