#pragma once

#include <complex>
#include <cstdint>

#include "frangia/core/image.h"

namespace frangia {

/// Effect of speckle on the fringes at one pixel: gain * {1 + gamma0 * Re(fringe * e^(i phi))}.
struct Speckle {
  float gain = 1.0F;                  ///< of the light; its mean is 1
  std::complex<float> fringe = 1.0F;  ///< of the fringes' contrast and phase
};

struct SpeckleOptions {
  double contrast = 0.0;     ///< rms of the gain, 0 to 1
  double grain_px = 1.5;     ///< full width at half maximum of the pattern's autocorrelation
  double correlation = 1.0;  ///< of the fields of the two interfering beams
};

/// Speckle of a view: two correlated laser beams on a rough surface, mixed with incoherent light.
///
/// @source   circular complex Gaussian fields, Goodman, Speckle Phenomena in Optics
[[nodiscard]] Image<Speckle> speckle_of(int width,
                                        int height,
                                        std::uint64_t stream,
                                        const SpeckleOptions& options);

}  // namespace frangia
