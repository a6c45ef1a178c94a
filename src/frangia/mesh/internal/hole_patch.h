#pragma once

#include <cstdint>
#include <vector>

#include "frangia/core/run.h"
#include "frangia/geometry/boundary.h"
#include "frangia/geometry/connectivity.h"
#include "frangia/geometry/mesh.h"

namespace frangia {

/// The triangles that fill a hole. Vertex indices below the vertex count of the mesh refer to the
/// mesh; the index of `positions_mm[i]` is that count plus i.
struct HolePatch {
  std::vector<Eigen::Vector3f> positions_mm;
  std::vector<Mesh::Triangle> triangles;  ///< empty when there is no such patch
};

/// Triangulates the boundary vertices with minimum area. A boundary of more than 100 vertices is
/// triangulated in its projection on the best-fitting plane, unless the projection intersects
/// itself.
[[nodiscard]] HolePatch flat_patch(const Mesh& mesh, const std::vector<std::uint32_t>& boundary);

/// A triangle fan around the centroid of the boundary vertices. It always exists.
[[nodiscard]] HolePatch fan_patch(const Mesh& mesh, const std::vector<std::uint32_t>& loop);

struct SmoothPatchOptions {
  double curvature = 1.0;  ///< share of the surrounding curvature; 0 is a minimal surface
  bool coarse = false;     ///< only the coarse triangulation that decides the shape
};

/// Computes a patch that continues the curvature and the density of the surface around a hole. A
/// patch of more than two million triangles gets coarser towards its centre.
///
/// The shape is faired on a coarse triangulation whose triangles grow inwards. Its edges are then
/// split along curves until they are as short as those outside.
///
/// @missing  an empty patch when the boundary allows none
/// @errors   Error(Cancelled)
[[nodiscard]] HolePatch smooth_patch(const Mesh& mesh,
                                     const HalfEdges& edges,
                                     const std::vector<std::uint32_t>& boundary,
                                     const SmoothPatchOptions& options = {},
                                     const Run& run = {});

}  // namespace frangia
