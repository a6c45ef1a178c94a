#pragma once

#include <span>

namespace frangia {

/// The orientation that the EXIF data of a whole JPEG file state, 1 to 8; 1 where they state none.
///
/// @source   CIPA DC-008 (Exif 2.32), 4.6.4: tag 0x0112 of the first directory
[[nodiscard]] int orientation_of_jpeg(std::span<const char> file);

/// The same of a block of EXIF data, which begins with the header of a TIFF, such as eXIf of PNG.
[[nodiscard]] int orientation_of_exif(std::span<const char> exif);

/// The same of a PNG file.
[[nodiscard]] int orientation_of_png(std::span<const char> file);

}  // namespace frangia
