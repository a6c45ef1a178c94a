#pragma once

#include <vector>

#include "frangia/core/image.h"
#include "frangia/frames/png.h"

namespace frangia {

/// Pictures side by side, each row of them as high as `row_height_px`, on white.
///
/// Pictures are scaled by averaging areas; shorter rows are padded.
/// errors   Error(Input) when there is no picture
[[nodiscard]] Image<Rgb> contact_sheet(const std::vector<std::vector<Image<Rgb>>>& rows,
                                       int row_height_px,
                                       int gap_px = 12);

/// The part of a picture within a margin around what is not black.
[[nodiscard]] Image<Rgb> crop_to_content(const Image<Rgb>& picture, int margin_px);

}  // namespace frangia
