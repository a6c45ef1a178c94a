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

/// Result of the search for the poses of views.
struct FoundPoses {
  std::size_t reference = 0;          ///< the view whose pose is held
  std::vector<std::size_t> left_out;  ///< views that fit no other, or in more than one pose;
                                      ///< they are emptied
  std::size_t found = 0;              ///< number of views with a pose, including the reference
  double least_overlap = 0.0;         ///< of all joins, as a share of the smaller side
  double accuracy_mm = 0.0;           ///< bound on the error of the poses

  [[nodiscard]] std::string text() const;  ///< the result as a sentence
};

/// Finds the relative poses of views from their shape alone, and sets the poses of `views`. They
/// are starting values for `register_poses`.
///
/// @shape    `maps`, `names`: one a view; the maps of views that are left out are emptied, too
/// @missing  a view that fits no other, or in more than one pose, is named in a warning and emptied
/// @errors   Error(Input) when no two views fit together
[[nodiscard]] FoundPoses find_view_poses(ViewStore& views,
                                         std::vector<SurfelMap>& maps,
                                         const CameraModel& camera,
                                         std::span<const std::string> names,
                                         const Run& run = {});

/// Whether the poses of the views can be right to within `reach_mm`: hardly any point of one view
/// lies in front of the surface that another view measured.
[[nodiscard]] bool are_poses_plausible(const ViewStore& views,
                                       std::span<const SurfelMap> maps,
                                       const CameraModel& camera,
                                       double reach_mm);

}  // namespace frangia
