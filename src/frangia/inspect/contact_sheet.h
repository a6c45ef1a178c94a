#pragma once

#include <vector>

#include "frangia/core/image.h"
#include "frangia/frames/png.h"

namespace frangia {

/// Arranges pictures in rows on white. Pictures are scaled to `row_height_px` by area averaging.
///
/// @shape    as wide as the widest row
/// @units    pixels
/// @errors   Error(Input) without pictures, or when one is empty
[[nodiscard]] Image<Rgb> contact_sheet(const std::vector<std::vector<Image<Rgb>>>& rows,
                                       int row_height_px,
                                       int gap_px = 12);

/// Crops a picture to its pixels that are not black, plus a margin.
///
/// @missing  a black picture is returned unchanged
[[nodiscard]] Image<Rgb> crop_to_content(const Image<Rgb>& picture, int margin_px);

}  // namespace frangia
