#pragma once

#include <cstdint>
#include <span>

#include "frangia/fusion/fusion_parameters.h"
#include "frangia/geometry/mesh.h"

namespace frangia {

/// Removes foldovers, in place: triangles that deviate from the normals of their vertices by more
/// than `foldover_rad`.
///
/// Where noise is as large as the triangles, a vertex may lie beyond its neighbours. It is relaxed
/// towards their mean along the surface, not across it. At the boundary the triangle is removed
/// instead. Triangles that still face inward after that are removed, too.
/// @shape    `sharp`: not 0 for a vertex on an edge or a corner of the object, which does not move;
///          it may be shorter than the list of vertices
void remove_foldovers(Mesh& mesh,
                      std::span<const std::uint8_t> sharp,
                      const CleanupParameters& parameters = {});

}  // namespace frangia
