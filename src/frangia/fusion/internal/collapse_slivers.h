#pragma once

#include <cstdint>
#include <span>

#include "frangia/fusion/fusion_parameters.h"
#include "frangia/fusion/internal/sliver_candidates.h"
#include "frangia/geometry/mesh.h"

namespace frangia {

/// Collapses edges shorter than `shortest_mm`, in place. Returns whether any was collapsed.
///
/// A vertex on a corner of the object keeps its position before one on an edge, and that before any
/// other; two of the same kind meet in the middle. No collapse folds a triangle over or makes the
/// mesh non-manifold. Removed triangles stay in the list with three times vertex 0.
///
/// @shape    `sharp`: 1 for a vertex on an edge of the object, 2 on a corner, else 0; it may be
///          shorter than the list of vertices. `candidates`: the triangles to examine; those around
///          collapsed edges are added
bool collapse_slivers(Mesh& mesh,
                      std::span<const std::uint8_t> sharp,
                      float shortest_mm,
                      SliverCandidates& candidates,
                      const CleanupParameters& parameters = {});

}  // namespace frangia
