#pragma once

#include <vector>

#include "frangia/geometry/mesh.h"

namespace frangia {

/// Whether each vertex is at the boundary of a mesh: its triangles do not close around it.
///
/// @shape    one for each vertex; a vertex without a triangle is not at the boundary
[[nodiscard]] std::vector<bool> boundary_vertices(const Mesh& mesh);

}  // namespace frangia
