#pragma once

#include "frangia/geometry/mesh.h"

namespace frangia {

/// The mesh with boundaries joined that run beside each other.
///
/// Vertices on boundaries that lie within the tolerance of each other become one, at the place of
/// the first; ends of the same edge never do. Triangles that lose their area on the way go, and
/// what stops being manifold is parted again. units    mm; 0 joins only what lies at the very same
/// place
[[nodiscard]] Mesh stitch(Mesh mesh, double tolerance_mm = 0.0);

}  // namespace frangia
