#pragma once

#include <complex>
#include <optional>
#include <vector>

#include "frangia/phase/internal/fringe_curve.h"
#include "frangia/rig/fringe_waveform.h"

namespace frangia {

/// Largest standard deviation of an offset that frames determine, relative to the modulation.
inline constexpr double kMaxOffsetSigma = 0.005;

/// A harmonic and an offset that change the apparent contrast with the phase.
struct ContrastFit {
  std::complex<double> harmonic = 0.0;  ///< relative to the fundamental
  double harmonic_sigma = 0.0;          ///< of its amplitude
  /// The third harmonic of three frames, from the ripple of their mean; empty where none is seen.
  std::optional<std::complex<double>> third{};
  /// Added to modulation times exp(i phase), relative to the modulation: the effect of unequal
  /// gains of the frames.
  std::complex<double> offset = 0.0;
  double offset_sigma = 0.0;  ///< of its amplitude; infinite if the pixels cover part of a fringe
  bool determined = false;    ///< enough tiles see enough of a fringe
};

/// Fits the harmonic of this order, given the others of `known`, to the contrasts within tiles.
[[nodiscard]] ContrastFit fit_contrast(const FringeBins& bins,
                                       const std::vector<double>& shifts_rad,
                                       const FringeWaveform& known,
                                       int order);

}  // namespace frangia
