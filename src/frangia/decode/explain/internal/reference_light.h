#pragma once

#include <Eigen/Core>

#include "frangia/decode/explain/internal/frame_sample.h"

namespace frangia {

/// How much more likely mean, modulation and phase of the pixels are by what other patterns of the
/// view show of them than without.
struct ReferenceGain {
  /// Log density of each pixel: several nats where they agree, less than 0 where they do not; 0
  /// where the other patterns do not measure it.
  Eigen::ArrayXd pixels;
  /// The same of all together: the mean light of all patterns of a projector is alike.
  double common = 0.0;
};

/// Compares mean, modulation and phase with those of other patterns. Their ratios and the
/// difference of the phases, and the spread of each, are those of most counted pixels.
///
/// @shape    `values`: mean, B cos(phi), B sin(phi) of each pixel; `counted`: 1 for pixels that
///           count
[[nodiscard]] ReferenceGain reference_gain(const FrameSample& sample,
                                           const Eigen::MatrixXd& values,
                                           const Eigen::ArrayXd& counted);

}  // namespace frangia
