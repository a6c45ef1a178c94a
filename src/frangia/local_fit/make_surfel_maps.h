#pragma once

#include <cstddef>
#include <vector>

#include "frangia/core/run.h"
#include "frangia/local_fit/surfel_map.h"
#include "frangia/rig/camera_model.h"
#include "frangia/views/view_store.h"

namespace frangia {

/// Every view in little, each loaded once.
///
/// shape    one a view, of at most about `pixels` surfels
[[nodiscard]] std::vector<SurfelMap> make_surfel_maps(const ViewStore& views,
                                                      const CameraModel& camera,
                                                      std::size_t pixels = 250000,
                                                      const Run& run = {});

}  // namespace frangia
