#include "frangia/phase/wrap/noise_of_view.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <span>
#include <vector>

#include "frangia/core/error.h"
#include "frangia/core/statistics.h"

namespace frangia {
namespace {

constexpr double kDiffers = 2.0;  ///< ratio of variances that no estimate of good frames has
/// Ratio of the variances at two distances and at one beyond which it is not white.
constexpr double kWhiteNoise = 1.3;
constexpr int kFar_px = 2;
constexpr std::size_t kShowNoise = 3;  ///< frames, of three the sum or, of coarse fringes, each

/// Where noise models are compared, counts: lit pixels of good frames are about as bright.
double compared_at(int white_level) {
  return 0.25 * white_level;
}

}  // namespace

NoiseModel common_noise(std::span<const NoiseSamples> views) {
  require(!views.empty(), "common_noise: no view");
  std::vector<double> variances;
  for (const NoiseSamples& view : views)
    variances.push_back(view.model().variance(compared_at(view.white_level())));
  const double middle = median(variances);
  NoiseSamples all(views.front().distance_px());
  for (std::size_t i = 0; i < views.size(); ++i)
    if (variances[i] < kDiffers * middle && variances[i] * kDiffers > middle) all.add(views[i]);
  return all.model();
}

NoiseModel noise_of_view(std::span<const FrameStack> stacks, const NoiseModel& known) {
  const FrameStack* quietest = nullptr;  // a fault between the frames is seldom in all patterns
  NoiseModel own;
  double least = std::numeric_limits<double>::infinity();
  for (const FrameStack& stack : stacks) {
    if (stack.pattern.kind != PatternKind::Fringe || stack.frames.size() < kShowNoise) continue;
    NoiseSamples samples;
    samples.add(stack);
    if (samples.empty()) continue;
    const NoiseModel model = samples.model();
    const double variance = model.variance(compared_at(stack.white_level));
    if (variance >= least) continue;
    least = variance;
    own = model;
    quietest = &stack;
  }
  if (quietest == nullptr) return known;
  const double at = compared_at(quietest->white_level);
  const double expected = known.variance(at);
  if (least * kDiffers < expected) return own;
  if (least < kDiffers * expected) return known;
  NoiseSamples far(kFar_px);
  far.add(*quietest);
  return far.model().variance(at) < kWhiteNoise * least ? own : known;
}

}  // namespace frangia
