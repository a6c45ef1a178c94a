#pragma once

#include <cstdint>
#include <span>

#include "frangia/core/image.h"

namespace frangia {

/// A frame of a webcam's Motion JPEG stream.
struct MjpegFrame {
  Image<std::uint8_t> brightness;  ///< its luminance
  int quality = 0;                 ///< 1 to 100, from its quantization table
};

/// Decodes the luminance of a frame of a Motion JPEG stream. Such frames often leave out their
/// Huffman tables, which are then those of ITU-T T.81, annex K, and hold stray bytes.
///
/// @errors   Error(Input) when the frame is not of `width_px` x `height_px`, truncated or damaged
[[nodiscard]] MjpegFrame decode_mjpeg(std::span<const std::uint8_t> bytes,
                                      int width_px,
                                      int height_px);

}  // namespace frangia
