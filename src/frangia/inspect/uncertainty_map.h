#pragma once

#include <vector>

#include "frangia/core/run.h"
#include "frangia/geometry/mesh.h"
#include "frangia/inspect/surface_patches.h"

namespace frangia {

/// The nominal surface with the uncertainty by which it was measured.
struct UncertaintyMap {
  Mesh mesh;                  ///< the reference, its triangles divided to the size of a patch
  std::vector<float> u95_mm;  ///< of each vertex; NaN: not measured
};

/// Draws the uncertainty of patches on the reference that they lie on. Large triangles are divided;
/// vertices between their halves lie on edges of others, which does not show in a picture.
///
/// @units    mm
/// @missing  NaN where no patch on the same face was measured
/// @errors   Error(Cancelled)
[[nodiscard]] UncertaintyMap uncertainty_map(const SurfacePatches& patches,
                                             const Mesh& reference,
                                             const Run& run = {});

}  // namespace frangia
