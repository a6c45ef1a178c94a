#pragma once

#include <cstddef>
#include <cstdint>
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

}  // namespace frangia
