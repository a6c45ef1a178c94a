#pragma once

#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

#include "frangia/frames/frame_stack.h"
#include "frangia/frames/noise_model.h"
#include "frangia/phase/algorithm/phase_algorithm.h"
#include "frangia/phase/waveform/fit_waveform.h"

namespace frangia {

/// The harmonics of the fringes in a combination of the frames.
class CombinedHarmonics {
 public:
  /// Finds the harmonics; there are none for fewer than four frames.
  CombinedHarmonics(const FrameStack& stack, std::vector<double> weights)
      : fit_(least_squares(stack.pattern.shifts_rad)),
        shifts_(stack.pattern.shifts_rad),
        weights_(std::move(weights)) {
    if (shifts_.size() < 4) return;
    // The noise is not known yet; the scatter of the residuals decides.
    constexpr std::size_t kHarmonicSamples = 10'000;
    waveform_ =
        fit_waveform(
            stack, shifts_, NoiseModel{}, {.samples = kHarmonicSamples, .min_harmonic = 0.002})
            .waveform;
    for (const auto& harmonic : waveform_.harmonics)
      found_ = found_ || harmonic != 0.0;
  }
  [[nodiscard]] bool found() const { return found_; }
  /// Their value at a pixel, counts.
  [[nodiscard]] double value_at(const FrameStack& stack, int x, int y) const {
    double cosine = 0.0;
    double sine = 0.0;
    for (std::size_t k = 0; k < shifts_.size(); ++k) {
      const double counts = counts_at(stack.frames[k], x, y);
      cosine += fit_.cosine[k] * counts;
      sine += fit_.sine[k] * counts;
    }
    const double phase = std::atan2(sine, cosine);
    double value = 0.0;
    for (std::size_t k = 0; k < shifts_.size(); ++k)
      value += weights_[k] * waveform_.light_at(phase + shifts_[k]);
    return std::hypot(cosine, sine) * value;
  }

 private:
  PhaseAlgorithm fit_;
  std::vector<double> shifts_;
  std::vector<double> weights_;
  FringeWaveform waveform_;
  bool found_ = false;
};

}  // namespace frangia
