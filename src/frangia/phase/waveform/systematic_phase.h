#pragma once

#include <optional>

#include "frangia/phase/algorithm/fit_algorithm.h"
#include "frangia/phase/waveform/fringe_response.h"
#include "frangia/phase/wrap/phase_map.h"

namespace frangia {

/// Returns the rms phase error over a fringe that the harmonics of the fringes leave, after the
/// correction by `table` unless it is null. The compensation of flicker takes part.
///
/// @units    rad
[[nodiscard]] double harmonic_phase_error(const FittedAlgorithm& fitted,
                                          const ResponseTable* table);

/// The correction of the harmonics that the frames themselves show. Empty where they hardly shift
/// its phase, where their own uncertainty shifts it nearly as much, and where two phases measure
/// alike.
[[nodiscard]] std::optional<ResponseTable> own_correction(const FittedAlgorithm& fitted);

/// The systematic standard uncertainty of a phase and what it is made of.
struct SystematicPhase {
  double rad = 0.0;  ///< standard uncertainty
  /// Share of its variance by harmonics and flicker. They ripple along the fringes, which lie
  /// elsewhere on the surface in each view; errors of the shifts also have a constant part.
  double differing_share = 0.0;
};

/// Returns the systematic standard uncertainty of the phase of one pattern: harmonics that are not
/// corrected, or the uncertainty of those that are; flicker that is not compensated; what nothing
/// explains in the frames; errors of the shifts. All pixels share their causes. Quantization
/// differs from pixel to pixel and is part of the noise. 0 if no cause is significant, or if all
/// together stay below 0.0005 rad.
///
/// @units    rad
[[nodiscard]] SystematicPhase systematic_phase(const FittedAlgorithm& fitted,
                                               const ResponseTable* table = nullptr);

/// Returns `systematic_rad` of a map with one value at all measured pixels; empty for 0.
///
/// @missing  NaN where not measured
[[nodiscard]] Image<float> uniform_systematic(double systematic_rad,
                                              const Image<PixelStatus>& status);

}  // namespace frangia
