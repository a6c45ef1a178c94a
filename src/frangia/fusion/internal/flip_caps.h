#pragma once

#include "frangia/fusion/internal/sliver_candidates.h"
#include "frangia/geometry/mesh.h"

namespace frangia {

/// Flips the longest edge of each triangle lower than `lowest_mm`, in place. Returns whether any
/// edge was flipped.
///
/// No flip folds a triangle over or makes the mesh non-manifold. `candidates` are the triangles to
/// examine; those around flipped edges are added.
bool flip_caps(Mesh& mesh, float lowest_mm, SliverCandidates& candidates);

}  // namespace frangia
