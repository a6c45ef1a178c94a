#pragma once

#include <array>

namespace frangia {

/// Returns the quality from 1 to 100 whose quantization table is nearest to `steps`, the table of
/// the brightness in natural order, as libjpeg holds it.
///
/// @source   Independent JPEG Group: the table of ITU-T T.81, annex K, scaled by the quality
[[nodiscard]] int jpeg_quality(const std::array<int, 64>& steps);

/// Returns the quantization steps of the brightness at quality 50, in natural order.
[[nodiscard]] const std::array<int, 64>& jpeg_base_steps();

/// Returns the quality at which all steps are `scale` times those of quality 50, from 1 to 100.
[[nodiscard]] double jpeg_quality_of_scale(double scale);

/// Returns the variance that the compression of a JPEG of this quality adds to each pixel.
///
/// It explains the error of the phase beyond the noise that `estimate_noise` sees in the frames.
/// With fringes of 10 to 40 px, the error is 0.6 to 1.4 times the sigma that results.
/// @units    counts squared, of 8 bits
/// @source   measured by tools/jpeg_noise.py, whose output docs/your-own-frames.md holds
[[nodiscard]] double jpeg_noise_counts2(int quality);

/// The same for steps that are `scale` times those of quality 50.
[[nodiscard]] double jpeg_noise_of_scale(double scale);

}  // namespace frangia
