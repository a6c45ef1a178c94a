#pragma once

#include <array>
#include <vector>

#include "frangia/frames/frame_stack.h"
#include "frangia/phase/internal/combined_harmonics.h"
#include "frangia/phase/wrap/estimate_noise.h"

namespace frangia {

/// Absolute differences, counts, binned by brightness.
using NoiseBins = std::array<std::vector<float>, NoiseSamples::kBins>;

/// Gathers the noise in rows of one combination of the frames.
class NoiseRowGatherer {
 public:
  /// `stack` must outlive the gatherer; one weight a frame.
  NoiseRowGatherer(const FrameStack& stack, std::vector<double> weights);
  /// Adds the absolute second differences along a row.
  void gather(int y, NoiseBins& bins) const;

 private:
  const FrameStack* stack_;
  std::vector<double> weights_;
  CombinedHarmonics harmonics_;
};

}  // namespace frangia
