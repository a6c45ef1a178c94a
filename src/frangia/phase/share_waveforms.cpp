#include "frangia/phase/share_waveforms.h"

#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

namespace frangia {
namespace {

/// Largest sigma of a determined harmonic, relative to the fundamental; a significant one may have
/// a larger sigma.
constexpr double kMaxHarmonicSigma = 0.02;
constexpr double kMinSigmas = 5.0;  ///< least amplitude of a significant harmonic, in sigmas

bool determines(const WaveformFit& fit, std::size_t harmonic) {
  if (harmonic >= fit.sigma.size()) return false;
  return fit.sigma[harmonic] < kMaxHarmonicSigma ||
         std::abs(fit.waveform.harmonics[harmonic]) > kMinSigmas * fit.sigma[harmonic];
}

}  // namespace

void share_waveforms(std::span<FittedAlgorithm> fits) {
  std::vector<WaveformFit> own;
  for (const FittedAlgorithm& fit : fits)
    own.push_back(fit.waveform);
  for (FittedAlgorithm& fit : fits) {
    WaveformFit& to = fit.waveform;
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
