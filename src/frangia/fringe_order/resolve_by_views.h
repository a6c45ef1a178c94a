#pragma once

#include <cstddef>
#include <vector>

#include "frangia/core/run.h"
#include "frangia/fringe_order/fringe_order_candidates.h"
#include "frangia/fringe_order/resolve_regions.h"
#include "frangia/views/view_store.h"

namespace frangia {

/// An unresolved region and the view that it belongs to.
struct UnresolvedViewRegion {
  std::size_t view = 0;     ///< index of the view
  UnresolvedRegion region;  ///< region in that view
};

/// Numbers of points whose fringe order other views decided.
struct ResolveByViewsResult {
  std::size_t resolved_points = 0;  ///< points that received a fringe order and joined their view
  std::size_t removed_points = 0;   ///< points whose fringe order stays unknown
};

/// Determines the fringe orders of unresolved regions from the surface that other views measured.
///
/// The order wins at which other views confirm most of the region without a free-space violation.
/// A resolved region is added to its view and helps to resolve the next one. Regions that remain
/// unresolved stay missing.
[[nodiscard]] ResolveByViewsResult resolve_by_views(
    ViewStore& views,
    const std::vector<UnresolvedViewRegion>& unresolved,
    const FringeOptics& optics,
    const Run& run = {});

}  // namespace frangia
