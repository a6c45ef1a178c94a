#pragma once

#include "frangia/range/range_grid.h"
#include "frangia/rig/camera_model.h"
#include "frangia/views/view.h"

namespace frangia {

/// Returns the distance of the pixels that are kept, so that a view of this camera has at most
/// `pixels` of them; at least 1.
[[nodiscard]] int thinning_step(const CameraModel& camera, double pixels);

/// Returns the camera that has every `step`-th pixel along rows and columns, from the first on.
[[nodiscard]] CameraModel thinned(CameraModel camera, int step);

/// Returns depth and sigma at the pixels of the thinned camera.
///
/// @units    mm, rig frame
/// @missing  as in `range`
[[nodiscard]] RangeGrid thinned(const RangeGrid& range, int step);

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
