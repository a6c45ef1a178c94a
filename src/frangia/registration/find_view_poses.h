#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "frangia/core/run.h"
#include "frangia/local_fit/surfel_map.h"
#include "frangia/rig/camera_model.h"
#include "frangia/views/view_store.h"

namespace frangia {

/// What came of views whose places nobody knew.
struct FoundPoses {
  std::size_t reference = 0;          ///< the view whose pose is held
  std::vector<std::size_t> left_out;  ///< views that fit no other, or more than one way; emptied
  std::size_t found = 0;
  double least_overlap = 0.0;  ///< of what was joined, a share of the smaller side
  double accuracy_mm = 0.0;    ///< how near the places are to the true ones

  [[nodiscard]] std::string text() const;
};

/// Finds from the shape alone how views stand to each other, and sets the poses of `views`: a start
/// for `register_poses`.
///
/// shape    `maps`, `names`: one a view; those of views that are left out are emptied, too
/// missing  a view that fits no other, or in more than one place, is warned of by name and emptied
/// errors   Error(Input) when no two views fit together
[[nodiscard]] FoundPoses find_view_poses(ViewStore& views,
                                         std::vector<SurfelMap>& maps,
                                         const CameraModel& camera,
                                         std::span<const std::string> names,
                                         const Run& run = {});

/// Whether the poses that views have can be right to within `reach_mm`: hardly any point of one
/// lies before what another saw.
[[nodiscard]] bool are_poses_plausible(const ViewStore& views,
                                       std::span<const SurfelMap> maps,
                                       const CameraModel& camera,
                                       double reach_mm);

}  // namespace frangia
