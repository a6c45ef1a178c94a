#pragma once

#include "frangia/core/run.h"
#include "frangia/geometry/mesh.h"

namespace frangia {

/// Orients neighbouring triangles consistently and closed components outwards.
///
/// An open component keeps the orientation of the larger part of its area. A non-orientable
/// component (a Moebius strip) stays inconsistent along some edges.
///
/// @errors   Error(Cancelled)
[[nodiscard]] Mesh orient(Mesh mesh, const Run& run = {});

/// Reverses the orientation of all triangles and normals.
[[nodiscard]] Mesh reverse_orientation(Mesh mesh);

}  // namespace frangia
