#pragma once

#include "frangia/fusion/internal/sliver_candidates.h"
#include "frangia/geometry/mesh.h"

namespace frangia {

/// Turns the longest edge of each triangle that is lower than `lowest_mm`, in place, so that its
/// three corners no longer lie in a row.
///
/// Nothing is turned that would fold a triangle over or make the mesh non-manifold. Returns whether
/// any was. `rough` tells what to look at; those around what was turned are added.
bool flip_caps(Mesh& mesh, float lowest_mm, SliverCandidates& candidates);

}  // namespace frangia
