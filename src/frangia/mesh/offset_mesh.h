#pragma once

#include "frangia/core/run.h"
#include "frangia/geometry/mesh.h"

namespace frangia {

/// Offsets a surface outwards, or inwards by a negative distance. Each vertex moves to the point
/// where the offset planes of its triangles intersect, so planar faces stay planar and edges sharp.
///
/// Where the radius of curvature is smaller than the distance the result intersects itself; use
/// remove_self_intersections. Vertices that move beyond their sigma are marked as displaced.
///
/// @units    mm
/// @errors   Error(Input) when nothing is left, because every vertex comes nearer to the surface
///          than the distance; Error(Cancelled)
[[nodiscard]] Mesh offset_mesh(Mesh mesh, double distance_mm, const Run& run = {});

}  // namespace frangia
