#pragma once

#include <span>

#include "frangia/frames/noise_model.h"

namespace frangia::phase {

/// The variance that pixels of about one brightness showed.
struct VarianceAt {
  double counts;            ///< brightness
  double variance_counts2;  ///< above 0
  double samples;           ///< of which it was estimated
};

/// Fits a noise model to variances. It is a straight line over the brightness; where the noise
/// falls with brightness, as that of cameras that encode their light, the model has a dark part
/// instead.
///
/// @units    counts
/// @missing  without variances the model is quantization noise
/// @source   EMVA 1288, photon transfer curve
[[nodiscard]] NoiseModel fit_noise(std::span<const VarianceAt> variances, int white_level);

}  // namespace frangia::phase
