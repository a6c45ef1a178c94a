#pragma once

#include <cstddef>

#include "frangia/core/run.h"
#include "frangia/geometry/mesh.h"

namespace frangia {

/// Connects two boundary loops of a mesh with a band of triangles marked as synthesized.
///
/// The band starts at the closest pair of vertices and advances along the loop whose next vertex
/// gives the shorter edge. Loops of two components join the components; two loops of one component
/// make a handle.
///
/// @shape    `first` and `second` are indices into boundary_loops
/// @errors   Error(Input) when a loop does not exist or both are the same; Error(Cancelled)
[[nodiscard]] Mesh bridge_loops(Mesh mesh,
                                std::size_t first,
                                std::size_t second,
                                const Run& run = {});

}  // namespace frangia
