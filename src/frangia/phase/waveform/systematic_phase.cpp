#include "frangia/phase/waveform/systematic_phase.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include "frangia/core/angles.h"
#include "frangia/core/missing.h"
#include "frangia/core/parallel.h"
#include "frangia/phase/algorithm/phase_algorithm.h"

namespace frangia {
namespace {

constexpr int kErrorPhases = 360;  ///< phases per fringe
/// A tenth of the phase noise of bright 8-bit frames after fusion of 100 pixels.
constexpr double kNegligible_rad = 5e-4;

/// Rms over a fringe of the error of the phase of frames with this waveform and the fitted gains.
double rms_error(const FittedAlgorithm& fitted,
                 const FringeWaveform& waveform,
                 const ResponseTable* table) {
  const std::vector<double>& shifts = fitted.shifts_rad;
  std::vector<double> gains = fitted.waveform.gains;
  gains.resize(shifts.size(), 0.0);
  std::vector<double> light(shifts.size());
  double square = 0.0;
  for (int i = 0; i < kErrorPhases; ++i) {
    const double phase = kTwoPi * (i + 0.37) / kErrorPhases;
    for (std::size_t k = 0; k < shifts.size(); ++k) {
      light[k] = fitted.waveform.gain_of_mean(gains[k]) * fitted.waveform.mean_over_modulation +
                 (1.0 + gains[k]) * waveform.light_at(phase + shifts[k]);
    }
    double found = phase_of(fitted.algorithm, light);
    if (table != nullptr) found += correction_at(*table, found);
    const double error = wrap_rad(found - phase);
    square += error * error / kErrorPhases;
  }
  return std::sqrt(square);
}

/// Square of the rms phase error by the uncertainty of the harmonics, through the correction: where
/// frames of a sharp wave hardly tell the phases of a part of the fringe apart, the correction
/// magnifies it.
double harmonic_variance(const FittedAlgorithm& fitted, const ResponseTable* table) {
  const FringeWaveform& known = fitted.waveform.waveform;
  const double left = std::pow(rms_error(fitted, known, table), 2);
  double square = 0.0;
  for (std::size_t i = 0; i < known.harmonics.size(); ++i) {
    if (known.harmonics[i] == 0.0) continue;
    for (const double sign : {-1.0, 1.0}) {
      FringeWaveform other = known;
      other.harmonics[i] += sign * fitted.waveform.sigma[i];
      square += 0.5 * std::max(0.0, std::pow(rms_error(fitted, other, table), 2) - left);
    }
  }
  return square;
}

}  // namespace

std::optional<ResponseTable> own_correction(const FittedAlgorithm& fitted) {
  constexpr double kWins = 2.0;  // error over what the correction leaves uncertain
  const double error = harmonic_phase_error(fitted, nullptr);
  if (error < kNegligible_rad) return {};
  auto table = find_response_table(
      fitted.waveform.waveform, fitted.algorithm, fitted.shifts_rad, fitted.waveform.gains);
  if (!table || error < kWins * std::sqrt(harmonic_variance(fitted, &*table))) return {};
  return table;
}

double harmonic_phase_error(const FittedAlgorithm& fitted, const ResponseTable* table) {
  if (fitted.waveform.largest_harmonic() == 0) return 0.0;
  return rms_error(fitted, fitted.waveform.waveform, table);
}

SystematicPhase systematic_phase(const FittedAlgorithm& fitted, const ResponseTable* table) {
  double square =
      std::pow(harmonic_phase_error(fitted, table), 2) + harmonic_variance(fitted, table);
  square += std::pow(fitted.waveform.flicker_error_rad, 2);
  square += std::pow(fitted.unexplained_rad, 2);
  const double differing = square;
  if (fitted.step.found && fitted.algorithm.name != "aia") {
    // Independent errors of N shifts change the phase by sqrt(2 / N) of their size.
    const auto frames = static_cast<double>(fitted.shifts_rad.size());
    square += std::pow(fitted.step.jitter_rad, 2) * 2.0 / frames;
  }
  const double sigma = std::sqrt(square);
  if (sigma < kNegligible_rad) return {};
  return {sigma, differing / square};
}

Image<float> uniform_systematic(double systematic_rad, const Image<PixelStatus>& status) {
  if (systematic_rad == 0.0) return {};
  Image<float> out(status.width(), status.height(), Uninitialized{});
  parallel_rows(status.height(), [&](int y) {
    for (int x = 0; x < status.width(); ++x) {
      out(x, y) =
          status(x, y) == PixelStatus::Measured ? static_cast<float>(systematic_rad) : kMissing;
    }
  });
  return out;
}

}  // namespace frangia
