#pragma once

#include "frangia/surface/local_planes.h"

namespace frangia {

/// Carries planes on to pixels that have none, in place, and marks the quads that they reach as
/// Beside.
void carry_planes(LocalPlanes& view, int reach_px);

}  // namespace frangia
