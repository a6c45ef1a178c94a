#pragma once

#include <cstdint>
#include <vector>

#include "frangia/geometry/mesh.h"

namespace frangia {

/// Finds the triangles whose corners are at the same three positions as those of an earlier
/// triangle, in any order.
///
/// @shape    indices of triangles, ascending
/// @missing  positions that are not finite are never the same
/// @errors   a vertex index out of range is a precondition violation
[[nodiscard]] std::vector<std::uint32_t> repeated_triangles(const Mesh& mesh);

}  // namespace frangia
