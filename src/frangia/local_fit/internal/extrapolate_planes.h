#pragma once

#include "frangia/local_fit/local_planes.h"

namespace frangia {

/// Extends planes to pixels without one, up to `extrapolate_px` pixels away, in place. Marks the
/// unseen quads that then have a plane at a corner as Extrapolated.
void extrapolate_planes(LocalPlanes& view, int extrapolate_px);

}  // namespace frangia
