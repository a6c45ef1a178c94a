#pragma once

#include <cstddef>
#include <cstdint>

#include "frangia/frames/frame_stack.h"
#include "frangia/phase/phase_algorithm.h"
#include "frangia/phase/wrap_tile.h"

namespace frangia {

/// Whether the algorithm is that of four frames a quarter turn apart: its sine of the second and
/// fourth only, its cosine of the others, its mean of all alike.
[[nodiscard]] bool are_quarters(const PhaseAlgorithm& algorithm);

/// Where the phases of a tile go.
struct TilePhase {
  float* phase_rad;
  float* precision;    ///< one over the variance of the phase
  float* least;        ///< of all maps so far; infinite before the first
  std::uint16_t* top;  ///< brightest of all frames so far; 0 before the first
};

/// Phase and precision of the pixels [at, at + n), n at most kTilePixels, of four frames for which
/// `are_quarters` holds, in one pass: no sum is ever stored.
void wrap_quarters(const FrameStack& stack,
                   const PhaseAlgorithm& algorithm,
                   const TileNoise& noise,
                   std::size_t at,
                   std::size_t n,
                   const TilePhase& out);

}  // namespace frangia
