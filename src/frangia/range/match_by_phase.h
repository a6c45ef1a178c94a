#pragma once

#include "frangia/core/image.h"
#include "frangia/core/run.h"
#include "frangia/range/camera_phases.h"

namespace frangia {

/// Finds the depth of each pixel of `first` from the point of `second` on its epipolar line that
/// has the same phase, without the projector.
///
/// The projector shows a phase on a surface that meets an epipolar plane in a curve, on which more
/// than one point of an object may lie. With one direction of fringes, a pixel is therefore matched
/// only if its phase occurs once on the epipolar line of either camera. With two, the second
/// direction decides between the candidates.
///
/// The result is accurate to about a pixel of `second`; `fuse_cameras` refines it.
///
/// @shape    w x h of `first`
/// @units    mm, along the optical axis of `first`
/// @missing  NaN where the phase is missing, or has no match or several
/// @errors   Error(Input) when both cameras have the same centre; Error(Cancelled)
[[nodiscard]] Image<float> match_by_phase(const CameraPhases& first,
                                          const CameraPhases& second,
                                          const Run& run = {});

}  // namespace frangia
