#pragma once

#include <cstddef>
#include <cstdint>

#include "frangia/frames/frame_stack.h"
#include "frangia/phase/algorithm/phase_algorithm.h"
#include "frangia/phase/internal/wrap_tile.h"

namespace frangia {

/// Computes the sums over all frames for the pixels [at, at + n), n <= kTilePixels, and raises
/// `brightest` to the largest counts of each.
void sum_frames(const FrameStack& stack,
                const PhaseAlgorithm& algorithm,
                std::size_t at,
                std::size_t n,
                WrapTile& tile,
                std::uint16_t* brightest);

}  // namespace frangia
