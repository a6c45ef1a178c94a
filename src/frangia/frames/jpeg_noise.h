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
/// It explains the error of the phase beyond the noise that `estimate_noise` sees in the frames.
/// With fringes of 10 to 40 px, the error is 0.6 to 1.4 times the sigma that results.
/// @units    counts squared, of 8 bits
/// @source   measured by tools/jpeg_noise.py, whose output docs/your-own-frames.md holds
[[nodiscard]] double jpeg_noise_counts2(int quality);

}  // namespace frangia
