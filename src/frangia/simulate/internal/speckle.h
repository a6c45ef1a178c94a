#pragma once

#include <complex>
#include <cstdint>

#include "frangia/core/image.h"

namespace frangia {

/// What speckle makes of the fringes at one pixel: gain * {1 + gamma0 * Re(fringe * e^(i phi))}.
struct Speckle {
  float gain = 1.0F;                  ///< of the light; its mean is 1
  std::complex<float> fringe = 1.0F;  ///< of the fringes' contrast and phase
};

struct SpeckleOptions {
  double contrast = 0.0;     ///< rms of the gain, 0 to 1
  double grain_px = 1.5;     ///< full width at half height of the pattern's own correlation
  double correlation = 1.0;  ///< of the fields of the two interfering beams
};

/// The speckle of a view: two correlated laser beams on a rough surface, mixed with light that does
/// not speckle.
///
/// source   circular complex Gaussian fields, Goodman, Speckle Phenomena in Optics
[[nodiscard]] Image<Speckle> speckle_of(int width,
                                        int height,
                                        std::uint64_t stream,
                                        const SpeckleOptions& options);

}  // namespace frangia
