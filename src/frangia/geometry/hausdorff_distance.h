#pragma once

#include "frangia/core/run.h"
#include "frangia/geometry/mesh.h"
#include "frangia/geometry/ray_scene.h"

namespace frangia {

/// The farthest that a point of either surface lies from the other: their Hausdorff distance, at
/// the vertices, the middles of the edges and of the triangles of both, and at points inside large
/// triangles as far apart as `spacing_mm`.
///
/// units    mm
/// errors   Error(Input) when one of the two has no triangle, or the spacing is not positive
[[nodiscard]] double hausdorff_distance_mm(const RayScene& a,
                                           const RayScene& b,
                                           double spacing_mm,
                                           const Run& run = {});

/// The mean length of a mesh's edges.
[[nodiscard]] double mean_edge_length_mm(const Mesh& mesh);

}  // namespace frangia
