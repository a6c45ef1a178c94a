#pragma once

#include "frangia/frames/image_file.h"

namespace frangia {

/// Whether an orientation of EXIF, 1 to 8, exchanges width and height.
[[nodiscard]] constexpr bool exchanges_sides(int orientation) {
  return orientation >= 5;
}

/// Turns an image as its orientation says it is to be shown.
///
/// @shape    width and height are exchanged for 5 to 8
/// @source   TIFF 6.0, section 8: 2 mirrored, 3 by 180 degrees, 4 upside down and mirrored, 6 by 90
///           degrees clockwise, 8 counterclockwise, 5 and 7 these mirrored
[[nodiscard]] RasterImage turn_image(const RasterImage& image, int orientation);

}  // namespace frangia
