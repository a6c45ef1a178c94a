#pragma once

#include "frangia/geometry/mesh.h"

namespace frangia {

/// The surface moved outwards by a distance (inwards when negative): each vertex goes to where the
/// planes of its triangles meet after they have moved, so that flat faces stay flat and edges
/// sharp.
///
/// Where the surface curves more than the distance it crosses itself: remove_self_intersections.
/// All moved vertices are marked.
[[nodiscard]] Mesh offset_mesh(Mesh mesh, double distance_mm);

}  // namespace frangia
