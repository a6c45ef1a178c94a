#pragma once

#include <cstddef>
#include <cstdint>

#include "frangia/frames/frame_stack.h"
#include "frangia/phase/internal/wrap_tile.h"
#include "frangia/phase/phase_algorithm.h"

namespace frangia {

/// Whether the algorithm is that of four frames a quarter turn apart: its sine of the second and
/// fourth only, its cosine of the others, its mean of all alike.
[[nodiscard]] bool is_four_step(const PhaseAlgorithm& algorithm);

/// Frames for which `is_four_step` holds, and the noise of their sums.
struct FourStepFrames {
  const FrameStack& stack;
  const PhaseAlgorithm& algorithm;
  const TileNoise& noise;
};

/// Where the phases of a tile go.
struct TilePhase {
  float* phase_rad;
  float* precision;          ///< one over the variance of the phase
  float* lowest_precision;   ///< of all maps so far; infinite before the first
  std::uint16_t* brightest;  ///< brightest of all frames so far; 0 before the first
};

/// Phase and precision of the pixels [at, at + n), n at most kTilePixels, in one pass: no sum is
/// ever stored.
void wrap_four_step(const FourStepFrames& frames,
                    std::size_t at,
                    std::size_t n,
                    const TilePhase& out);

}  // namespace frangia
