#include "frangia/phase/wrap/internal/phase_kernel.h"

#include <cmath>

#include <fmt/format.h>

#include "frangia/core/error.h"
#include "frangia/core/vectorized.h"
#include "frangia/phase/internal/fast_atan2.h"
#include "frangia/phase/wrap/internal/sum_frames.h"
#include "frangia/phase/wrap/internal/wrap_four_step.h"

namespace frangia {
namespace {

void check_frames(const FrameStack& stack, const PhaseAlgorithm& algorithm) {
  if (stack.frames.size() != algorithm.sine.size()) {
    throw Error(ErrorKind::Input,
                fmt::format(R"(pattern "{}" has {} frames, but the algorithm "{}" takes {})",
                            stack.pattern.name,
                            stack.frames.size(),
                            algorithm.name,
                            algorithm.sine.size()));
  }
  for (const Frame& frame : stack.frames) {
    require(width_of(frame) == width_of(stack.frames.front()) &&
                height_of(frame) == height_of(stack.frames.front()) &&
                frame.index() == stack.frames.front().index(),
            "wrap_phase: the frames differ in size or depth");
  }
}

SumNoise noise_of_sums(const PhaseAlgorithm& algorithm, const NoiseModel& noise) {
  double sine_gain = 0.0;
  double cosine_gain = 0.0;
  double cross_gain = 0.0;
  for (std::size_t k = 0; k < algorithm.sine.size(); ++k) {
    sine_gain += algorithm.sine[k] * algorithm.sine[k];
    cosine_gain += algorithm.cosine[k] * algorithm.cosine[k];
    cross_gain += algorithm.sine[k] * algorithm.cosine[k];
  }
  if (!algorithm.outer.empty()) {  // nonlinear algorithm: mean over the fringe
    sine_gain = cosine_gain = algorithm.noise_gain * algorithm.noise_gain;
    cross_gain = 0.0;
  }
  return {.variance_floor = static_cast<float>(noise.floor_counts2),
          .variance_slope = static_cast<float>(noise.slope_counts),
          .sine_gain = static_cast<float>(sine_gain),
          .cosine_gain = static_cast<float>(cosine_gain),
          .cross_gain = static_cast<float>(cross_gain)};
}

FRANGIA_VECTORIZED void find_phase(const WrapTile& __restrict tile,
                                   std::size_t n,
                                   float* __restrict phase_rad) {
  for (std::size_t i = 0; i < n; ++i)
    phase_rad[i] = fast_atan2(tile.sine[i], tile.cosine[i]);
}

/// `kAll`: modulation and mean, too.
template <bool kAll>
FRANGIA_VECTORIZED void find_precision(const WrapTile& __restrict tile,
                                       std::size_t n,
                                       SumNoise f,
                                       const TilePhase& out) {
  float* __restrict precision = out.precision;
  float* __restrict modulation = out.modulation_counts;
  float* __restrict means = out.mean_counts;
  for (std::size_t i = 0; i < n; ++i) {
    const float s = tile.sine[i];
    const float c = tile.cosine[i];
    const float square = s * s + c * c;
    const float mean = tile.mean[i] > 0.0F ? tile.mean[i] : 0.0F;
    const float variance = f.variance_floor + f.variance_slope * mean;
    const float gain = c * c * f.sine_gain + s * s * f.cosine_gain - 2.0F * s * c * f.cross_gain;
    precision[i] = square * square / (variance * gain + kLeastVariance);
    if constexpr (kAll) {
      modulation[i] = std::sqrt(square);
      means[i] = tile.mean[i];
    }
  }
}

}  // namespace

PhaseKernel::PhaseKernel(const FrameStack& stack,
                         const PhaseAlgorithm& algorithm,
                         const NoiseModel& noise)
    : stack_(&stack),
      algorithm_(&algorithm),
      noise_(noise_of_sums(algorithm, noise)),
      is_four_step_(is_four_step(algorithm)) {
  check_frames(stack, algorithm);
}

void PhaseKernel::wrap(std::size_t at,
                       std::size_t n,
                       WrapTile& scratch,
                       const TilePhase& out) const {
  if (is_four_step_) {
    wrap_four_step({*stack_, *algorithm_, noise_}, at, n, out);
    return;
  }
  sum_frames(*stack_, *algorithm_, at, n, scratch, out.brightest);
  find_phase(scratch, n, out.phase_rad);
  if (out.modulation_counts != nullptr) {
    find_precision<true>(scratch, n, noise_, out);
  } else {
    find_precision<false>(scratch, n, noise_, out);
  }
}

}  // namespace frangia
