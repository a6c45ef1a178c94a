#pragma once

#include <cstddef>
#include <vector>

#include "frangia/geometry/mesh.h"
#include "frangia/mesh/internal/hole_patch.h"

namespace frangia {

/// Numbers of pairs of intersecting triangles of which at least one belongs to a patch.
struct PatchIntersections {
  std::size_t inside = 0;       ///< away from the boundary: the shape of the patch is wrong
  std::size_t at_boundary = 0;  ///< within a few triangles of it, due to slivers and noise

  [[nodiscard]] std::size_t all() const { return inside + at_boundary; }
};

/// Counts the intersections of each patch with itself, with the other patches and with the mesh.
///
/// @shape    one element per patch
/// @errors   Error(Input) in a build without CGAL: see can_test_intersections; Error(Cancelled)
[[nodiscard]] std::vector<PatchIntersections> patch_intersections(
    const Mesh& mesh, const std::vector<HolePatch>& patches, const Run& run = {});

}  // namespace frangia
