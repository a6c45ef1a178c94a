#pragma once

#include <cstddef>
#include <vector>

#include "frangia/core/run.h"
#include "frangia/rig/lens.h"
#include "frangia/views/plane_map.h"
#include "frangia/views/view_store.h"

namespace frangia {

/// Every view in little, each loaded once.
///
/// shape    one a view, of at most about `pixels` spots
[[nodiscard]] std::vector<PlaneMap> map_views(const ViewStore& views,
                                              const Lens& camera,
                                              std::size_t pixels = 250000,
                                              const Run& run = {});

}  // namespace frangia
