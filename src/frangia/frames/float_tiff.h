#pragma once

#include <filesystem>

#include "frangia/core/image.h"

namespace frangia {

/// Writes an image as a 32-bit floating-point TIFF, which ImageJ, Fiji, GIMP and OpenCV read.
///
/// @missing  NaN stays NaN
/// @errors   Error(File) when the file cannot be written
void write_float_tiff(const std::filesystem::path& path, const Image<float>& image);

}  // namespace frangia
