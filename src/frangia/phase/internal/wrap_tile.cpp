#include "frangia/phase/internal/wrap_tile.h"

#include <fmt/format.h>

#include "frangia/core/error.h"
#include "frangia/core/vectorized.h"
#include "frangia/phase/internal/fast_atan2.h"

namespace frangia {

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

TileNoise tile_noise(const FrameStack& stack,
                     const PhaseAlgorithm& algorithm,
                     const NoiseModel& noise) {
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
  return {.white = stack.white_level,
          .variance_floor = static_cast<float>(noise.floor_counts2),
          .variance_slope = static_cast<float>(noise.slope_counts),
          .sine_gain = static_cast<float>(sine_gain),
          .cosine_gain = static_cast<float>(cosine_gain),
          .cross_gain = static_cast<float>(cross_gain)};
}

FRANGIA_VECTORIZED void find_tile_phase(const WrapTile& __restrict tile,
                                        std::size_t n,
                                        float* __restrict phase_rad) {
  for (std::size_t i = 0; i < n; ++i)
    phase_rad[i] = fast_atan2(tile.sine[i], tile.cosine[i]);
}

}  // namespace frangia
