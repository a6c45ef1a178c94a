#pragma once

#include <complex>
#include <vector>

#include "frangia/phase/internal/fringe_curve.h"

namespace frangia {

/// Largest order of a fitted harmonic.
inline constexpr int kMaxHarmonic = 5;

/// Harmonics and gains from the residuals of the fringe fit.
struct ResidualFit {
  std::vector<bool> observable;                 ///< of harmonics 2, 3, ...
  std::vector<std::complex<double>> harmonics;  ///< 0 where not observable
  std::vector<double> sigma;                    ///< of each amplitude; NaN where not observable
  std::vector<double> gains;                    ///< relative, mean 0; empty unless fitted
  double steady_share = 0.0;   ///< of the mean counts: light of the room, which no gain acts on
  double gain_sigma = 0.0;     ///< rms standard deviation of the gains
  double gain_chi2 = 0.0;      ///< what gains explain beyond harmonics, over what nothing explains
  bool gains_explain = false;  ///< gains fit the residuals, and better than errors of the shifts
};

/// What gains of the frames are fitted.
enum class GainFit {
  None,
  Small,    ///< their effects alone: whether the frames flicker at all
  Flicker,  ///< with their products: they act on the harmonics, and not on steady light
};

/// Fits the binned residuals.
[[nodiscard]] ResidualFit fit_residuals(const FringeBins& bins,
                                        const std::vector<double>& shifts_rad,
                                        GainFit gain_fit);

/// The part of the weighted sum of squared residuals that harmonics explain.
[[nodiscard]] double explained_residual(const FringeBins& bins,
                                        const std::vector<double>& shifts_rad);

}  // namespace frangia
