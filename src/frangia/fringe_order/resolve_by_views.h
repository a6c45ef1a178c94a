#pragma once

#include <cstddef>
#include <vector>

#include "frangia/core/run.h"
#include "frangia/fringe_order/fringe_order_candidates.h"
#include "frangia/fringe_order/resolve_regions.h"
#include "frangia/views/view_store.h"

namespace frangia {

/// A unresolved regions and the view it belongs to.
struct UnresolvedViewRegion {
  std::size_t view = 0;
  UnresolvedRegion region;
};

struct ResolveByViewsOptions {
  std::size_t min_region_px = 30;  ///< smaller regions are not worth a guess
  int max_samples = 400;           ///< points of a region that are compared
  double tolerance = 0.06;      ///< of the depth between two fringes: how near counts as agreeing
  double min_agreement = 0.15;  ///< share of a region's points that another view must confirm
  double max_runner_up = 0.5;   ///< the second best fringe must be worse than the best by this
};

struct ResolveByViewsResult {
  std::size_t resolved_points = 0;
  std::size_t removed_points = 0;
};

/// Fixes the whole number of fringes of unresolved regions by the surface that other views saw
/// there: the fringe that puts a region where others measured it, and not in front of what they
/// saw, wins. What is resolved is added to its view and helps the next. The rest is dropped.
[[nodiscard]] ResolveByViewsResult resolve_by_views(
    ViewStore& views,
    const std::vector<UnresolvedViewRegion>& unresolved,
    const FringeOptics& optics,
    const ResolveByViewsOptions& options = {},
    const Run& run = {});

}  // namespace frangia
