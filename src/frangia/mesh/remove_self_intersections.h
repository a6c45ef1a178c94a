#pragma once

#include "frangia/core/run.h"
#include "frangia/geometry/mesh.h"

namespace frangia {

/// The mesh without triangles that cross others. What is away from crossings stays as it is.
///
/// Closed parts that cross each other become one body: what lies inside goes, the rest is joined
/// where they met. Elsewhere the triangles that cross go, what they cut off goes with them when it
/// is less than a tenth of its part, and the wounds are closed and marked as invented; then what
/// still crosses, with a ring of triangles more each time. What was closed is closed; a boundary
/// that was there stays one.
/// errors   Error(Input) as self_intersections
[[nodiscard]] Mesh remove_self_intersections(Mesh mesh, const Run& run = {});

}  // namespace frangia
