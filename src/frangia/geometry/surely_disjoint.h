#pragma once

#include "frangia/geometry/triangles_intersect.h"

namespace frangia {

/// Whether two triangles surely do not cross: a quick answer before triangles_intersect.
///
/// Coordinates are floats and sums are of doubles: what is called parted is so beyond rounding.
[[nodiscard]] bool surely_disjoint(const IndexedTriangle& a, const IndexedTriangle& b);

}  // namespace frangia
