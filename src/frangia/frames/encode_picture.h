#pragma once

#include <vector>

#include "frangia/core/image.h"
#include "frangia/frames/png.h"

namespace frangia {

/// Encodes a color picture as the bytes of a PNG.
///
/// @errors   Error(File) when it cannot be encoded
[[nodiscard]] std::vector<char> encode_picture(const Image<Rgb>& picture);

}  // namespace frangia
