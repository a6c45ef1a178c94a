#pragma once

#include <cstddef>
#include <vector>

#include "frangia/mesh/hole_patch.h"
#include "frangia/surface/mesh.h"

namespace frangia {

/// Pairs of crossing triangles of which at least one is a patch's.
struct PatchCrossings {
  std::size_t inside = 0;  ///< away from the rim: the patch's shape is wrong
  std::size_t at_rim = 0;  ///< within a few triangles of it: slivers and noise there

  [[nodiscard]] std::size_t all() const { return inside + at_rim; }
};

/// How each patch crosses itself, the others, and the mesh that they are to be put into.
///
/// shape    one a patch
/// errors   Error(Input) in a build without CGAL: see can_tell_what_crosses
[[nodiscard]] std::vector<PatchCrossings> patch_crossings(const Mesh& mesh,
                                                          const std::vector<HolePatch>& patches);

}  // namespace frangia
