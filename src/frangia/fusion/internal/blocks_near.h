#pragma once

#include <cstdint>
#include <vector>

#include "frangia/fusion/internal/distance_field.h"

namespace frangia {

/// Returns the keys of all blocks that hold a corner of a cell near the surface of a view, in
/// ascending order.
[[nodiscard]] std::vector<std::uint64_t> blocks_near(const LocalPlanes& view,
                                                     const CameraRays& camera,
                                                     const TruncationBand& band);

}  // namespace frangia
