#pragma once

#include "frangia/local_fit/local_planes.h"

namespace frangia {

/// Carries planes on to pixels that have none, in place, and marks the quads that they reach as
/// Extrapolated.
void extrapolate_planes(LocalPlanes& view, int extrapolate_px);

}  // namespace frangia
