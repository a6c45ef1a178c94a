#pragma once

#include <cstdint>
#include <span>

#include "frangia/fusion/internal/sliver_candidates.h"
#include "frangia/geometry/mesh.h"

namespace frangia {

/// Joins vertices that an edge shorter than `shortest_mm` connects, in place.
///
/// The sharper of two vertices stays where it is: on a corner of the object, then on an edge; two
/// alike meet in the middle. Nothing is joined that would fold a triangle over or make the mesh
/// non-manifold. Returns whether any was joined; triangles that vanish are left as three times
/// vertex 0.
///
/// shape    `sharp`: 1 for a vertex on an edge of the object, 2 on a corner; further ones are on
///          none. `rough`: what to look at; those around what was joined are added
bool collapse_slivers(Mesh& mesh,
                      std::span<const std::uint8_t> sharp,
                      float shortest_mm,
                      SliverCandidates& candidates);

}  // namespace frangia
