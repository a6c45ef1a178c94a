#pragma once

#include <cstdint>
#include <vector>

#include "frangia/fusion/internal/distance_field.h"

namespace frangia {

/// Returns the keys of all blocks that hold a corner of a cell near the surface of a view, in
/// ascending order.
///
/// @errors   Error(Input) when a point is more than 4 million voxels from the origin
[[nodiscard]] std::vector<std::uint64_t> blocks_near(const LocalPlanes& view,
                                                     const CameraRays& camera,
                                                     const TruncationBand& band);

}  // namespace frangia
