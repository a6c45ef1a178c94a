#pragma once

#include <cstddef>
#include <vector>

#include "frangia/geometry/mesh.h"
#include "frangia/mesh/internal/hole_patch.h"

namespace frangia {

/// Pairs of crossing triangles of which at least one is a patch's.
struct PatchIntersections {
  std::size_t inside = 0;       ///< away from the boundary: the patch's shape is wrong
  std::size_t at_boundary = 0;  ///< within a few triangles of it: slivers and noise there

  [[nodiscard]] std::size_t all() const { return inside + at_boundary; }
};

/// How each patch crosses itself, the others, and the mesh that they are to be put into.
///
/// shape    one a patch
/// errors   Error(Input) in a build without CGAL: see can_test_intersections
[[nodiscard]] std::vector<PatchIntersections> patch_intersections(
    const Mesh& mesh, const std::vector<HolePatch>& patches);

}  // namespace frangia
