#pragma once

#include <cstddef>
#include <vector>

#include "frangia/core/run.h"
#include "frangia/local_fit/surfel_map.h"
#include "frangia/rig/camera_model.h"
#include "frangia/views/view_store.h"

namespace frangia {

/// Number of surfels of a view that keeps them denser than the pairs of the registration.
inline constexpr std::size_t kSurfelsPerView = 250'000;

/// Largest number of surfels in the map of one view. It shrinks with the number of views from 24
/// on, so that the maps of all views hold six million surfels (170 MB) at most.
[[nodiscard]] std::size_t surfel_budget(std::size_t pixels, std::size_t views);

/// Builds the surfel map of every view. Each view is loaded once.
///
/// @shape    one map for each view, each of at most about `surfel_budget(pixels, views.size())`
///          surfels
/// @errors   Error(Input) when a view and the camera differ in size
[[nodiscard]] std::vector<SurfelMap> make_surfel_maps(const ViewStore& views,
                                                      const CameraModel& camera,
                                                      std::size_t pixels = kSurfelsPerView,
                                                      const Run& run = {});

}  // namespace frangia
