#pragma once

#include <cstdint>
#include <vector>

#include "frangia/geometry/boundary_loops.h"
#include "frangia/geometry/half_edges.h"
#include "frangia/geometry/mesh.h"

namespace frangia {

/// What closes a hole. Corners below the mesh's count of vertices are the mesh's own; the others
/// are counted on from there, in the order of `positions_mm`.
struct HolePatch {
  std::vector<Eigen::Vector3f> positions_mm;
  std::vector<Mesh::Triangle> triangles;  ///< none: there is no such patch
};

/// The triangulation of the boundary's corners with the least area; of larger holes that of its
/// projection on the plane that fits it best, as long as the projection does not cross itself.
[[nodiscard]] HolePatch flat_patch(const Mesh& mesh, const std::vector<std::uint32_t>& boundary);

/// A fan about the mean of the boundary's corners: always there.
[[nodiscard]] HolePatch fan_patch(const Mesh& mesh, const std::vector<std::uint32_t>& loop);

struct SmoothPatchOptions {
  double curvature = 1.0;  ///< share of the surroundings': 0 is a film of least area
  bool coarse = false;     ///< the shape alone, of few triangles: a fraction of the work
};

/// As dense as the surface around the boundary and curved on as it is; patches of more than two
/// million triangles get coarser inwards. None when the boundary leaves no way.
///
/// The shape is found on few triangles that grow inwards, then cut along curves between their
/// corners until they are as small as those outside.
[[nodiscard]] HolePatch smooth_patch(const Mesh& mesh,
                                     const HalfEdges& edges,
                                     const std::vector<std::uint32_t>& boundary,
                                     const SmoothPatchOptions& options = {});

}  // namespace frangia
