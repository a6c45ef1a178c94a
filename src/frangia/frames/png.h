#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <vector>

#include "frangia/core/image.h"
#include "frangia/frames/frame.h"

namespace frangia {

/// A grey PNG of up to 8 bits, or of 16.
///
/// errors   Error(Input) that names the file: missing, not a PNG, truncated, in colour, or larger
///          than 65 535 pixels a side
[[nodiscard]] Frame read_png(const std::filesystem::path& path);

using Rgb = std::array<std::uint8_t, 3>;

/// The bytes of a grey PNG, for whoever keeps them with a checksum.
///
/// errors   Error(File) when it cannot be encoded
[[nodiscard]] std::vector<char> encode_png(const Frame& frame);

/// Writes a PNG whole or not at all.
///
/// errors   Error(File) when it cannot be written
void write_png(const std::filesystem::path& path, const Frame& frame);
void write_png(const std::filesystem::path& path, const Image<Rgb>& picture);

}  // namespace frangia
