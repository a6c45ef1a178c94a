#pragma once

#include "frangia/rig/camera_model.h"
#include "frangia/views/view.h"

namespace frangia {

/// Every `step`-th pixel of a camera, both ways, from the first on.
[[nodiscard]] CameraModel subsample(const CameraModel& camera, int step);

/// The view that it has.
///
/// shape    as the thinned camera's
[[nodiscard]] View subsample(const View& view, int step);

}  // namespace frangia
