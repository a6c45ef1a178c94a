#include "frangia/phase/waveform/measure_response.h"

#include <cstddef>
#include <vector>

#include "frangia/core/error.h"

namespace frangia {
namespace {

constexpr double kMinContrast =
    0.15;  ///< least contrast between the darkest and the brightest frame, as a fraction of white
constexpr std::size_t kMinIlluminated = 100;  ///< least number of pixels

/// Adds the counts of one view's illuminated pixels to the sum of each level; returns the number of
/// these pixels.
std::size_t add_illuminated(const FrameStack& ramp, std::vector<double>& sums) {
  const Frame& dark = ramp.frames.front();
  const Frame& full = ramp.frames.back();
  std::size_t illuminated = 0;
  for (int y = 0; y < height_of(full); ++y) {
    for (int x = 0; x < width_of(full); ++x) {
      const int brightest = counts_at(full, x, y);
      const int contrast = brightest - counts_at(dark, x, y);
      if (brightest >= ramp.white_level || contrast < kMinContrast * ramp.white_level) continue;
      ++illuminated;
      for (std::size_t k = 0; k < sums.size(); ++k)
        sums[k] += counts_at(ramp.frames[k], x, y);
    }
  }
  return illuminated;
}

}  // namespace

ResponseCurve measure_response(std::span<const FrameStack> ramps) {
  require(!ramps.empty(),
          "the scan has no pattern of kind \"ramp\", from which the response is measured");
  const std::vector<double>& levels = ramps.front().pattern.levels;
  std::vector<double> sums(levels.size(), 0.0);
  std::size_t illuminated = 0;
  for (const FrameStack& ramp : ramps) {
    require(ramp.pattern.levels == levels && ramp.frames.size() == levels.size(),
            "measure_response: the ramps differ in their levels or have another number of frames "
            "than levels");
    illuminated += add_illuminated(ramp, sums);
  }
  require(illuminated >= kMinIlluminated,
          "the ramp illuminates too few unsaturated pixels; check the exposure");
  return make_response_curve(levels, sums);
}

}  // namespace frangia
