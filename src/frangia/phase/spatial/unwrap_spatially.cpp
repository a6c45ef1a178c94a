#include "frangia/phase/spatial/unwrap_spatially.h"

#include <utility>

#include "frangia/phase/spatial/internal/discard_residues.h"
#include "frangia/phase/spatial/internal/unwrap_pixels.h"
#include "frangia/phase/spatial/internal/unwrap_run_merging.h"

namespace frangia {

RelativePhase unwrap_spatially(WrappedPhase phase, const SpatialUnwrapOptions& options) {
  discard_residues(phase);
  Regions regions = split_regions(phase, options.split);
  RelativePhase relative;
  Image<std::int32_t> order;
  if (options.keep_growth_order) order = unwrap_quality_guided(phase, regions, true).growth_order;
  switch (options.method) {
    case SpatialMethod::RunMerging:
      relative = unwrap_run_merging(std::move(phase), regions);
      break;
    case SpatialMethod::QualityGuided:
      relative = unwrap_quality_guided(phase, regions);
      break;
    case SpatialMethod::ReliabilitySorted:
      relative = unwrap_reliability_sorted(phase, regions);
      break;
  }
  relative.growth_order = std::move(order);
  join_regions(relative, regions, options.join);
  return relative;
}

}  // namespace frangia
