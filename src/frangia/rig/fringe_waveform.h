#pragma once

#include <complex>
#include <vector>

#include "frangia/pattern/pattern.h"

namespace frangia {

/// The waveform of projected fringes relative to their fundamental, without the mean: cos(phase) +
/// sum over n of Re(c_n exp(i n phase)). A nonlinear projector or camera adds the harmonics; blur
/// reduces them, so that they depend on the period.
struct FringeWaveform {
  double period_px = 0.0;  ///< period of the pattern that showed it; 0: any
  FringeDirection direction = FringeDirection::Vertical;  ///< of that pattern
  std::vector<std::complex<double>> harmonics;            ///< c_2, c_3, ...

  /// Returns the light at a phase, in units of the fundamental's amplitude.
  [[nodiscard]] double light_at(double phase_rad) const;
  /// Returns the amplitude of a harmonic; 0 where none is listed.
  [[nodiscard]] double amplitude(int order) const;
};

/// Returns the waveform that was measured with the period and the direction of a pattern, or the
/// one with the nearest period; null if no waveform has that direction.
///
/// @units    px
[[nodiscard]] const FringeWaveform* find_waveform(const std::vector<FringeWaveform>& waveforms,
                                                  const Pattern& pattern);

}  // namespace frangia
