#pragma once

#include <vector>

namespace frangia {

/// The light a projector gives for each level that it is driven with, both as shares of full.
struct ResponseCurve {
  std::vector<double> light;  ///< at evenly spaced levels from 0 to 1; from 0 to 1, never falling

  /// The light of a level.
  [[nodiscard]] double light_of(double level) const;
  /// The level that gives this light: what a pattern's look-up table holds.
  [[nodiscard]] double level_of(double light_fraction) const;
};

/// A curve from light measured at some levels, made monotone.
///
/// shape    as many levels as lights; levels rise and span 0 to 1
/// errors   Error(Input) when they do not, or when the last light is not above the first
/// source   pool adjacent violators, Ayer et al. 1955
[[nodiscard]] ResponseCurve make_response_curve(const std::vector<double>& levels,
                                                std::vector<double> light);

/// The response of a projector whose pattern was shown through the look-up table of `known`, and
/// then was seen to have the response `residual`.
[[nodiscard]] ResponseCurve compose(const ResponseCurve& known, const ResponseCurve& residual);

}  // namespace frangia
