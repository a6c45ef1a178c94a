#pragma once

#include <span>

namespace frangia {

/// Whether the two ends of the projector's field meet on a surface: neighbouring pixels of a line
/// lie at opposite ends, and the next pixels on either side at the same ends.
///
/// @shape    `places` in the field, from 0 to 1, one per pixel of the line
/// @missing  NaN: not measured
[[nodiscard]] bool is_split(std::span<const double> places);

}  // namespace frangia
