#pragma once

#include <vector>

namespace frangia {

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
