#pragma once

#include <cstddef>
#include <vector>

#include "frangia/core/run.h"
#include "frangia/local_fit/surfel_map.h"
#include "frangia/rig/camera_model.h"
#include "frangia/views/view_store.h"

namespace frangia {

/// Builds the surfel map of every view. Each view is loaded once.
///
/// @shape    one map for each view, each of at most about `pixels` surfels
/// @errors   Error(Input) when a view and the camera differ in size
[[nodiscard]] std::vector<SurfelMap> make_surfel_maps(const ViewStore& views,
                                                      const CameraModel& camera,
                                                      std::size_t pixels = 250000,
                                                      const Run& run = {});

}  // namespace frangia
