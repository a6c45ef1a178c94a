#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "frangia/core/image.h"

namespace frangia {

/// Regions within which the absolute phase has no jump, from the largest.
struct JumplessRegions {
  std::vector<std::int32_t> label;  ///< one for each pixel; -1 where there is no phase
  std::vector<std::size_t> size;    ///< pixels of each region
};

/// Finds the regions of neighbouring pixels whose absolute phases differ by less than half a
/// fringe.
[[nodiscard]] JumplessRegions find_jumpless_regions(const Image<float>& phase_rad);

/// Whether the two ends of the projector's field meet on a surface: neighbouring pixels of a line
/// lie at opposite ends, and the next pixels on either side at the same ends.
///
/// @shape    `places` in the field, from 0 to 1, one per pixel of the line
/// @missing  NaN: not measured
[[nodiscard]] bool is_split(std::span<const double> places);

}  // namespace frangia
