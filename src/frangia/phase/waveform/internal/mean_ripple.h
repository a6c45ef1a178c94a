#pragma once

#include <complex>

#include "frangia/phase/internal/fringe_bins.h"

namespace frangia {

/// Least number of pixels of a tile.
inline constexpr double kMinTilePixels = 30.0;

/// The change of the mean with a multiple of the phase.
struct MeanRipple {
  std::complex<double> amplitude = 0.0;  ///< relative to the mean
  double sigma = 0.0;                    ///< of the amplitude
};

/// Fits log mean to cosine and sine of `multiple` times the phase within tiles. Texture is noise.
[[nodiscard]] MeanRipple fit_mean_ripple(const FringeBins& bins, int multiple);

}  // namespace frangia
