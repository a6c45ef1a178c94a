#pragma once

#include <array>

namespace frangia {

/// Returns the quality from 1 to 100 whose quantization table is nearest to `steps`, the table of
/// the brightness in natural order, as libjpeg holds it.
///
/// @source   Independent JPEG Group: the table of ITU-T T.81, annex K, scaled by the quality
[[nodiscard]] int jpeg_quality(const std::array<int, 64>& steps);

/// Returns the variance that the compression of a JPEG of this quality adds to each pixel.
///
/// Measured on simulated fringe scans: the error of the phase beyond that of the uncompressed
/// frames, as the variance of a frame that explains it.
/// @units    counts squared, of 8 bits
/// @source   tools/jpeg_noise.py, whose output docs/your-own-frames.md holds
[[nodiscard]] double jpeg_noise_counts2(int quality);

}  // namespace frangia
