#pragma once

#include "frangia/rig/camera_model.h"
#include "frangia/views/view.h"

namespace frangia {

/// The camera of every `step`-th pixel along both axes, starting with pixel (0, 0).
///
/// @errors   Error(Input) when the step is less than one pixel
[[nodiscard]] CameraModel subsample(const CameraModel& camera, int step);

/// The view of the subsampled camera, without edge pixels.
///
/// @shape    that of `subsample(camera, step)`
/// @errors   Error(Input) when the step is less than one pixel
[[nodiscard]] View subsample(const View& view, int step);

}  // namespace frangia
