#pragma once

#include <cstddef>

#include "frangia/geometry/mesh.h"

namespace frangia {

/// The mesh with a band of triangles between two of its boundary loops, marked as invented.
///
/// The band begins where the loops are nearest and goes round both by the shorter of the two next
/// steps. A loop of one part and one of another join the parts; two of one part make a handle.
/// shape    the loops by their numbers in boundary_loops
/// errors   Error(Input) when there is no such loop, or both are one
[[nodiscard]] Mesh bridge_loops(Mesh mesh, std::size_t first, std::size_t second);

}  // namespace frangia
