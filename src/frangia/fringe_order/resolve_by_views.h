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

/// Criteria for the fringe order that other views confirm.
struct ResolveByViewsOptions {
  int max_samples = 400;        ///< maximum number of compared points of a region
  double tolerance = 0.06;      ///< distance that counts as agreement, per fringe spacing
  double min_agreement = 0.15;  ///< minimum score of the best order, per compared point
  double max_runner_up = 0.5;   ///< maximum score of the second best order, per best score
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
    const ResolveByViewsOptions& options = {},
    const Run& run = {});

}  // namespace frangia
