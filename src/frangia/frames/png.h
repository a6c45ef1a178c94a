#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <vector>

#include "frangia/core/image.h"
#include "frangia/frames/frame_stack.h"
#include "frangia/frames/image_file.h"

namespace frangia {

/// Accepts the size of an image, or throws. It is called before memory for the pixels is allocated.
using PngSizeCheck = std::function<void(int width_px, int height_px)>;

/// Reads a grey PNG. Depths up to 8 bits give an 8-bit frame, 16 bits a 16-bit frame.
///
/// @errors   Error(Input) that names the file when it is missing, not a regular file, not a PNG,
///          truncated, in colour, larger than 65 535 pixels a side, 250 million pixels, 1 GiB, or
///          than its bytes can hold; the error of `check_size`
[[nodiscard]] Frame read_png(const std::filesystem::path& path,
                             const PngSizeCheck& check_size = {});

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
/// Writes an image of 8 or 16 bits in grey or color as a PNG atomically.
///
/// @errors   Error(File) when it cannot be written; Error(Input) for floating-point samples
void write_png(const std::filesystem::path& path, const RasterImage& image);

}  // namespace frangia
