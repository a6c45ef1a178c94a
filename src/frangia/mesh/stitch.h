#pragma once

#include "frangia/core/run.h"
#include "frangia/geometry/mesh.h"

namespace frangia {

/// Merges boundary vertices that lie within a tolerance of each other.
///
/// A merged vertex keeps the position of the first one. The ends of one edge are never merged.
/// Triangles that degenerate are removed, and make_manifold splits what becomes non-manifold.
///
/// @units    mm; a tolerance of 0 merges vertices at the same position
/// @errors   Error(Input) for a negative tolerance; Error(Cancelled)
[[nodiscard]] Mesh stitch(Mesh mesh, double tolerance_mm = 0.0, const Run& run = {});

}  // namespace frangia
