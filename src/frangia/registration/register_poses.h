#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "frangia/core/run.h"
#include "frangia/local_fit/surfel_map.h"
#include "frangia/rig/camera_model.h"
#include "frangia/views/view_store.h"

namespace frangia {

struct RegisterPosesOptions {
  double reach_mm = 3.0;  ///< how far surfaces that are one may lie apart at the start
  int max_iterations = 60;
};

struct PosesReport {
  double rms_before_mm = 0.0;  ///< between the surfaces of different views, along the normal
  double rms_after_mm = 0.0;
  double overlap = 0.0;  ///< share of the points that another view saw, too
  int iterations = 0;    ///< 0: the poses stay as they were given

  [[nodiscard]] std::string text() const;
};

/// All views at once, each with a rigid pose of its own; the first is held. Sets the poses of
/// `views`.
///
/// shape    `maps`: one a view, as make_surfel_maps makes them
/// missing  views that do not overlap keep their poses, with a warning
/// source   projective association, Blais & Levine 1995; symmetric distance, Rusinkiewicz 2019;
///          Gauss-Newton with Tukey's biweight
[[nodiscard]] PosesReport register_poses(ViewStore& views,
                                         std::vector<SurfelMap> maps,
                                         const CameraModel& camera,
                                         const RegisterPosesOptions& options = {},
                                         const Run& run = {});

}  // namespace frangia
