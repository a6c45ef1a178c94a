#pragma once

#include <cstdint>

#include "frangia/core/image.h"

namespace frangia {

/// Limits of a phase difference between neighbours that counts as smooth.
struct JumpOptions {
  /// Largest deviation of a phase difference from the adjacent differences, in addition to five
  /// sigmas of their noise. A crease changes the difference by less, a depth step by any amount.
  float tolerance_rad = 0.1F;
  /// Largest smooth phase difference: 2 pi / 3, since a fringe covers at least three pixels (the
  /// paper).
  float max_jump_rad = 2.09F;
};

/// Marks with 1 the pixels whose wrapped phase difference to the right-hand neighbour is smooth:
/// small, and hardly outside the range of the two adjacent differences along the row.
///
/// @shape    w x h; 0 in the last column
/// @missing  0 where one of the two pixels is NaN
[[nodiscard]] Image<std::uint8_t> smooth_right(const Image<float>& phase_rad,
                                               const JumpOptions& options = {});
/// Marks with 1 the pixels whose wrapped phase difference to the neighbour below is smooth.
///
/// @shape    w x h; 0 in the last row
/// @missing  0 where one of the two pixels is NaN
[[nodiscard]] Image<std::uint8_t> smooth_below(const Image<float>& phase_rad,
                                               const JumpOptions& options = {});

}  // namespace frangia
