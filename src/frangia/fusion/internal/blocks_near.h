#pragma once

#include <cstdint>
#include <vector>

#include "frangia/fusion/internal/distance_field.h"

namespace frangia {

/// Keys of all blocks that hold a corner of a cell near what a view saw, ascending.
[[nodiscard]] std::vector<std::uint64_t> blocks_near(const LocalPlanes& view,
                                                     const CameraRays& camera,
                                                     const TruncationBand& band);

}  // namespace frangia
