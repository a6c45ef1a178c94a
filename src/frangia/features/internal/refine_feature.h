#pragma once

#include <optional>

#include "frangia/core/run.h"
#include "frangia/features/find_features.h"
#include "frangia/features/internal/surface_cells.h"

namespace frangia {

/// Fits the shape of a region to the points that are not at its border, and simpler shapes too; the
/// simplest that fits nearly as well is the feature. One that is wanted goes before all others
/// where it fits nearly all of the points. None when no shape is determined.
[[nodiscard]] std::optional<Feature> refine_feature(const FeaturePoints& points,
                                                    const SurfaceCells& cells,
                                                    const ShapeRegion& region,
                                                    double gate_mm,
                                                    const FindFeaturesOptions& options,
                                                    const Run& run);

}  // namespace frangia
