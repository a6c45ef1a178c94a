#pragma once

#include <cstdint>

#include "frangia/core/image.h"

namespace frangia {

struct JumpOptions {
  /// How far a jump between neighbours may lie from those beside it, besides the noise that the
  /// jumps themselves show: a crease bends the phase by less, a depth step by any amount.
  float tolerance_rad = 0.1F;
  /// A fringe is at least three pixels wide, as the paper asks.
  float max_jump_rad = 2.09F;
};

/// 1 where the jump of the wrapped phase to the right-hand neighbour is smooth: small, and not far
/// outside those before and behind it. 0 where one of the two is missing, and in the last column.
[[nodiscard]] Image<std::uint8_t> smooth_right(const Image<float>& phase_rad,
                                               const JumpOptions& options = {});
/// The same of the jump to the neighbour below.
[[nodiscard]] Image<std::uint8_t> smooth_below(const Image<float>& phase_rad,
                                               const JumpOptions& options = {});

}  // namespace frangia
