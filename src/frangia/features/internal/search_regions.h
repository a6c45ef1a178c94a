#pragma once

#include <span>
#include <vector>

#include <Eigen/Core>

#include "frangia/core/run.h"
#include "frangia/features/find_features.h"
#include "frangia/features/internal/surface_cells.h"

namespace frangia {

/// Regions of cells that lie on shapes, and the scatter of the cells about them.
struct FoundRegions {
  std::vector<ShapeRegion> regions;  ///< no two share a cell
  double gate_mm = 0.0;              ///< the largest distance of a cell from its shape
};

/// Looks for regions that lie on shapes: the largest first.
[[nodiscard]] FoundRegions search_regions(const FeaturePoints& points,
                                          const SurfaceCells& cells,
                                          const FindFeaturesOptions& options,
                                          const Run& run);

/// The region at each place of the surface, which may share cells; one without cells where the
/// surface lies on no shape there.
[[nodiscard]] FoundRegions regions_at(const FeaturePoints& points,
                                      const SurfaceCells& cells,
                                      std::span<const FeaturePlace> places,
                                      const FindFeaturesOptions& options,
                                      const Run& run);

}  // namespace frangia
