#include "frangia/phase/waveform/share_waveforms.h"

#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

#include "frangia/phase/waveform/internal/fit_contrast.h"

namespace frangia {
namespace {

/// Largest sigma of a determined harmonic, relative to the fundamental; a significant one may have
/// a larger sigma.
constexpr double kMaxHarmonicSigma = 0.02;
constexpr double kMinHarmonicSigmas =
    5.0;  ///< least amplitude of a significant harmonic, in sigmas

bool determines(const WaveformFit& fit, std::size_t harmonic) {
  if (harmonic >= fit.sigma.size()) return false;
  return fit.sigma[harmonic] < kMaxHarmonicSigma ||
         std::abs(fit.waveform.harmonics[harmonic]) > kMinHarmonicSigmas * fit.sigma[harmonic];
}

/// Whether the frames of a digital projector neither determine flicker nor compensate it.
bool lacks_flicker(const WaveformFit& fit) {
  return fit.gains.empty() && !(fit.offset_sigma < kMaxOffsetSigma) && fit.flicker_error_rad == 0.0;
}

/// Rms effect of flicker on the patterns of as many frames that determine it; 0 without any.
double shared_flicker(std::span<const FittedAlgorithm> fits,
                      const std::vector<WaveformFit>& own,
                      std::size_t frames) {
  double square = 0.0;
  double count = 0.0;
  for (std::size_t i = 0; i < fits.size(); ++i) {
    if (fits[i].shifts_rad.size() != frames || lacks_flicker(own[i]) || !own[i].gains.empty())
      continue;
    square += own[i].flicker_error_rad * own[i].flicker_error_rad;
    count += 1.0;
  }
  return count > 0.0 ? std::sqrt(square / count) : 0.0;
}

}  // namespace

void share_waveforms(std::span<FittedAlgorithm> fits) {
  std::vector<WaveformFit> own;
  for (const FittedAlgorithm& fit : fits)
    own.push_back(fit.waveform);
  for (FittedAlgorithm& fit : fits) {
    WaveformFit& to = fit.waveform;
    if (lacks_flicker(to)) to.flicker_error_rad = shared_flicker(fits, own, fit.shifts_rad.size());
    if (to.is_square) continue;  // its own third harmonic tells all others
    for (std::size_t harmonic = 0; harmonic < to.sigma.size(); ++harmonic) {
      if (determines(to, harmonic)) continue;
      const WaveformFit* nearest = nullptr;
      double least = std::numeric_limits<double>::infinity();
      for (const WaveformFit& from : own) {
        const double apart = std::abs(std::log(from.waveform.period_px / to.waveform.period_px));
        if (!determines(from, harmonic) || !(apart < least)) continue;
        nearest = &from;
        least = apart;
      }
      if (nearest == nullptr) continue;
      to.waveform.harmonics[harmonic] = nearest->waveform.harmonics[harmonic];
      to.sigma[harmonic] = nearest->sigma[harmonic];
    }
  }
}

}  // namespace frangia
