#pragma once

#include "frangia/mesh/triangles_cross.h"

namespace frangia {

/// Whether two triangles surely do not cross: a quick answer before triangles_cross.
///
/// Coordinates are floats and sums are of doubles: what is called parted is so beyond rounding.
[[nodiscard]] bool surely_parted(const CornerPlaces& a, const CornerPlaces& b);

}  // namespace frangia
