#pragma once

#include <optional>
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
/// instead. `cut_off` is that of pixels at 0 counts, which show less noise than they have: where it
/// exceeds the others' curve, the dark part comes from it.
///
/// @units    counts
/// @missing  without variances the model is quantization noise
/// @source   EMVA 1288, photon transfer curve
[[nodiscard]] NoiseModel fit_noise(std::span<const VarianceAt> variances,
                                   const std::optional<VarianceAt>& cut_off,
                                   int white_level);

}  // namespace frangia::phase
