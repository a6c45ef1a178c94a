#pragma once

#include <filesystem>

#include "frangia/core/image.h"

namespace frangia {

/// Writes numbers as a 32-bit floating point TIFF (ImageJ, Fiji, GIMP and OpenCV read it).
///
/// missing  NaN stays NaN
/// errors   Error(File) when it cannot be written
void write_float_tiff(const std::filesystem::path& path, const Image<float>& image);

}  // namespace frangia
