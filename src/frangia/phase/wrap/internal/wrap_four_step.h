#pragma once

#include <cstddef>
#include <cstdint>

#include "frangia/frames/frame_stack.h"
#include "frangia/phase/algorithm/phase_algorithm.h"
#include "frangia/phase/internal/wrap_tile.h"

namespace frangia {

/// Returns whether an algorithm is the four-step algorithm: its sine uses the second and fourth
/// frame, its cosine the first and third, and its mean all four equally.
[[nodiscard]] bool is_four_step(const PhaseAlgorithm& algorithm);

/// Frames for which `is_four_step` holds, and the noise of their weighted sums.
struct FourStepFrames {
  const FrameStack& stack;
  const PhaseAlgorithm& algorithm;
  const TileNoise& noise;
};

/// Output of a tile.
struct TilePhase {
  float* phase_rad;
  float* precision;          ///< inverse variance of the phase
  float* lowest_precision;   ///< minimum over all maps so far; initialize with a large number
  std::uint16_t* brightest;  ///< maximum over all frames so far; initialize with 0
};

/// Computes phase and precision of the pixels [at, at + n), n <= kTilePixels, without storing the
/// weighted sums.
void wrap_four_step(const FourStepFrames& frames,
                    std::size_t at,
                    std::size_t n,
                    const TilePhase& out);

}  // namespace frangia
