#pragma once

#include <cstddef>

#include "frangia/core/run.h"
#include "frangia/local_fit/local_planes.h"
#include "frangia/views/view_store.h"

namespace frangia {

/// How densely and how well the views saw the object.
struct Sampling {
  std::size_t points = 0;
  double spacing_mm = 0.0;  ///< median distance between the points of neighbouring pixels
  double sigma_mm = 0.0;    ///< median, along the ray
};

/// Looks at every 16th row of each view.
///
/// missing  without a point all are 0
[[nodiscard]] Sampling measure_sampling(const ViewStore& views,
                                        const CameraRays& camera,
                                        const Run& run = {});

}  // namespace frangia
