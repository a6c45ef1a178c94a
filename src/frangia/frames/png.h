#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <vector>

#include "frangia/core/image.h"
#include "frangia/frames/frame.h"

namespace frangia {

/// Reads a grey PNG. Depths up to 8 bits give an 8-bit frame, 16 bits a 16-bit frame.
///
/// @errors   Error(Input) that names the file when it is missing, not a PNG, truncated, in colour,
///          larger than 65 535 pixels a side or 250 million pixels, or of more pixels than its
///          bytes can hold
[[nodiscard]] Frame read_png(const std::filesystem::path& path);

using Rgb = std::array<std::uint8_t, 3>;  ///< red, green and blue, 0 to 255

/// Encodes a frame as the bytes of a grey PNG.
///
/// @errors   Error(File) when it cannot be encoded
[[nodiscard]] std::vector<char> encode_png(const Frame& frame);

/// Writes a PNG atomically.
///
/// @errors   Error(File) when it cannot be written
void write_png(const std::filesystem::path& path, const Frame& frame);
/// Writes a color PNG atomically.
///
/// @errors   Error(File) when it cannot be written
void write_png(const std::filesystem::path& path, const Image<Rgb>& picture);

}  // namespace frangia
