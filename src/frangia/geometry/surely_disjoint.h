#pragma once

#include "frangia/geometry/triangles_intersect.h"

namespace frangia {

/// Whether two triangles certainly do not intersect: a fast filter before `triangles_intersect`.
///
/// Coordinates are floats and the arithmetic is in double, with a bound on the rounding error. A
/// result of true is exact; false means undecided.
[[nodiscard]] bool surely_disjoint(const IndexedTriangle& a, const IndexedTriangle& b);

}  // namespace frangia
