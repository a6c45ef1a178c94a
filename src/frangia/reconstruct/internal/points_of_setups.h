#pragma once

#include <cstddef>
#include <vector>

#include "frangia/core/run.h"
#include "frangia/reconstruct/internal/register_setups.h"
#include "frangia/views/view_store.h"

namespace frangia {

/// Registered points of the reference camera in each joined setup, about `most` of each, evenly
/// over its pixels: to see how the setups join.
///
/// @shape    results: one for each join that is `joined`, in their order
/// @units    mm, object frame
[[nodiscard]] std::vector<PointCloud> points_of_setups(const MeasuredSetup& joined,
                                                       const Rig& rig,
                                                       std::size_t most,
                                                       const Run& run = {});

}  // namespace frangia
