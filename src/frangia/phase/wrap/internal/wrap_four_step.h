#pragma once

#include <cstddef>

#include "frangia/frames/frame_stack.h"
#include "frangia/phase/algorithm/phase_algorithm.h"
#include "frangia/phase/internal/wrap_tile.h"
#include "frangia/phase/wrap/internal/phase_kernel.h"

namespace frangia {

/// Returns whether an algorithm is the four-step algorithm: its sine uses the second and fourth
/// frame, its cosine the first and third, and its mean all four equally.
[[nodiscard]] bool is_four_step(const PhaseAlgorithm& algorithm);

/// Frames for which `is_four_step` holds, and the noise of their weighted sums.
struct FourStepFrames {
  const FrameStack& stack;
  const PhaseAlgorithm& algorithm;
  const SumNoise& noise;
};

/// Computes the pixels [at, at + n), n <= kTilePixels, as PhaseKernel does, from two differences of
/// counts instead of three weighted sums.
void wrap_four_step(const FourStepFrames& frames,
                    std::size_t at,
                    std::size_t n,
                    const TilePhase& out);

}  // namespace frangia
