#pragma once

#include <cstddef>
#include <cstdint>

#include "frangia/frames/frame_stack.h"
#include "frangia/phase/algorithm/phase_algorithm.h"
#include "frangia/phase/internal/wrap_tile.h"

namespace frangia {

/// Weighted sums over the frames of one tile.
struct WrapTile {
  alignas(64) Lane sine;
  alignas(64) Lane cosine;
  alignas(64) Lane mean;
  alignas(64) Lane outer;  ///< Carré's second difference
};

/// Computes the sums over all frames for the pixels [at, at + n), n <= kTilePixels, and raises
/// `brightest` to the largest counts of each.
void sum_frames(const FrameStack& stack,
                const PhaseAlgorithm& algorithm,
                std::size_t at,
                std::size_t n,
                WrapTile& tile,
                std::uint16_t* brightest);

}  // namespace frangia
