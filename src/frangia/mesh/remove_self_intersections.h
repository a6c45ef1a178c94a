#pragma once

#include "frangia/core/run.h"
#include "frangia/geometry/mesh.h"

namespace frangia {

/// Removes self-intersections. The mesh away from them is unchanged.
///
/// Closed components that intersect each other are united. Elsewhere the intersecting triangles are
/// removed, together with pieces that this cuts off if they hold less than a tenth of the area of
/// their component, and the new holes are filled and marked as synthesized. This repeats with one
/// more ring of triangles each time until no intersection is left. Existing boundaries stay open.
///
/// @errors   Error(Input) as self_intersections; Error(Cancelled)
[[nodiscard]] Mesh remove_self_intersections(Mesh mesh, const Run& run = {});

}  // namespace frangia
