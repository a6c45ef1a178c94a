#pragma once

#include "frangia/core/run.h"
#include "frangia/geometry/mesh.h"
#include "frangia/geometry/ray_scene.h"

namespace frangia {

/// Computes the Hausdorff distance of two surfaces: the largest distance of a point of either
/// surface from the other one. It samples the vertices, the centres of edges and triangles, and
/// points inside large triangles no farther apart than `spacing_mm`.
///
/// @units    mm
/// @errors   Error(Input) when a mesh has no triangle or the spacing is not positive
[[nodiscard]] double hausdorff_distance_mm(const RayScene& a,
                                           const RayScene& b,
                                           double spacing_mm,
                                           const Run& run = {});

/// Returns the mean length of the triangles' edges; 0 for a mesh without triangles.
[[nodiscard]] double mean_edge_length_mm(const Mesh& mesh);

}  // namespace frangia
