#pragma once

#include "frangia/geometry/mesh.h"

namespace frangia {

/// Gives shells that touch each other, in an edge or in a vertex, vertices of their own there, as
/// for meshes whose vertices were joined by their place. The sides of an edge of more than two
/// triangles that have no partner (`pair_sides`) stay together. No vertex moves, and no triangle is
/// removed.
///
/// @errors   as HalfEdges
[[nodiscard]] Mesh separate_shells(Mesh mesh);

}  // namespace frangia
