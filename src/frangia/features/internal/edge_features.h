#pragma once

#include <vector>

#include "frangia/features/find_features.h"
#include "frangia/features/internal/grow_region.h"

namespace frangia {

/// A surface that was found, with its region.
struct FoundSurface {
  Feature feature;
  ShapeRegion region;
};

/// The lines in which two planes meet, and the circles in which a plane meets a cylinder or a cone
/// about its normal. They are computed from the two surfaces, whose regions touch; the rounded edge
/// itself is not fitted.
[[nodiscard]] std::vector<Feature> edge_features(const std::vector<FoundSurface>& surfaces,
                                                 const SurfaceCells& cells);

}  // namespace frangia
