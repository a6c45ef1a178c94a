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

/// The response of a projector: the light it emits for each drive level, both as fractions of full.
struct ResponseCurve {
  std::vector<double>
      light;  ///< light at evenly spaced levels from 0 to 1; rises from 0 to 1, never falls

  /// Returns the light at a drive level.
  [[nodiscard]] double light_of(double level) const;
  /// Returns the drive level for a fraction of full light, as the look-up table of a pattern holds
  /// it.
  [[nodiscard]] double level_of(double light_fraction) const;
};

/// Fits a monotone response curve to the light measured at some levels.
///
/// @shape    one light value per level; the levels rise from 0 to 1
/// @errors   Error(Input) when the levels do not, or when the last light is not above the first
/// @source   pool adjacent violators, Ayer et al. 1955; Fritsch and Carlson 1980 between the levels
[[nodiscard]] ResponseCurve make_response_curve(const std::vector<double>& levels,
                                                std::vector<double> light);

/// Combines the response `known`, through whose look-up table a pattern was shown, with the
/// response `residual` measured from that pattern.
[[nodiscard]] ResponseCurve compose(const ResponseCurve& known, const ResponseCurve& residual);

}  // namespace frangia
