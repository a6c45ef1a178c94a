#include "frangia/phase/share_waveforms.h"

#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

namespace frangia {
namespace {

/// Largest sigma of a determined harmonic, relative to the fundamental.
constexpr double kMaxHarmonicSigma = 0.01;

bool determines(const WaveformFit& fit, std::size_t harmonic) {
  return harmonic < fit.sigma.size() && fit.sigma[harmonic] < kMaxHarmonicSigma;
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
