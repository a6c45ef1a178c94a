#pragma once

#include <cstdint>
#include <vector>

#include "frangia/core/run.h"
#include "frangia/geometry/half_edges.h"
#include "frangia/geometry/mesh.h"
#include "frangia/mesh/internal/hole_patch.h"

namespace frangia {

using VertexLoop = std::vector<std::uint32_t>;

/// Computes a smooth patch for each hole, or the best replacement as fill_holes describes.
///
/// @shape    one patch per loop; a loop visits no vertex twice
/// @errors   Error(Cancelled)
[[nodiscard]] std::vector<HolePatch> choose_smooth_patches(const Mesh& mesh,
                                                           const HalfEdges& edges,
                                                           const std::vector<VertexLoop>& loops,
                                                           const Run& run = {});

/// Computes a flat patch for each hole, or a fan.
///
/// @shape    one patch per loop; a loop visits no vertex twice
/// @errors   Error(Cancelled)
[[nodiscard]] std::vector<HolePatch> choose_flat_patches(const Mesh& mesh,
                                                         const HalfEdges& edges,
                                                         const std::vector<VertexLoop>& loops,
                                                         const Run& run = {});

}  // namespace frangia
