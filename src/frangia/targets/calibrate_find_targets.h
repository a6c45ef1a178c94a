#pragma once

#include <vector>

#include "frangia/core/image.h"
#include "frangia/range/range_grid.h"
#include "frangia/rig/camera_model.h"
#include "frangia/rig/target_set.h"
#include "frangia/targets/target_sighting.h"

namespace frangia {

/// Finds the targets in an image of one view, and measures their centres in 3D.
///
/// A plane is fitted to the measured points around each spot or marker; what is printed is then
/// projected from that plane, blurred, and compared with the image, so that neither perspective nor
/// blur moves the centre. The covariance holds the noise of the image and that of the plane.
///
/// @shape    `counts` without fringes, of the size of `range` and of `camera`
/// @units    counts; mm, rig frame
/// @missing  a target without measured points around it is not found
/// @errors   Error(Input) when the sizes differ
[[nodiscard]] std::vector<TargetSighting> find_targets(const Image<float>& counts,
                                                       const RangeGrid& range,
                                                       const CameraModel& camera,
                                                       const TargetSet& targets);

}  // namespace frangia
