#pragma once

#include <cstddef>
#include <vector>

#include "frangia/core/run.h"
#include "frangia/range/anchor_phase.h"
#include "frangia/views/fringe_candidates.h"
#include "frangia/views/view_store.h"

namespace frangia {

/// A loose region and the view it belongs to.
struct LoosePart {
  std::size_t view = 0;
  LooseRegion region;
};

struct AnchorByViewsOptions {
  std::size_t min_region_px = 30;  ///< smaller regions are not worth a guess
  int max_samples = 400;           ///< points of a region that are compared
  double tolerance = 0.06;      ///< of the depth between two fringes: how near counts as agreeing
  double min_agreement = 0.15;  ///< share of a region's points that another view must confirm
  double max_runner_up = 0.5;   ///< the second best fringe must be worse than the best by this
};

struct AnchorByViewsResult {
  std::size_t anchored_points = 0;
  std::size_t dropped_points = 0;
};

/// Fixes the whole number of fringes of loose regions by the surface that other views saw there:
/// the fringe that puts a region where others measured it, and not in front of what they saw, wins.
/// What is anchored is added to its view and helps the next. The rest is dropped.
[[nodiscard]] AnchorByViewsResult anchor_by_views(ViewStore& views,
                                                  const std::vector<LoosePart>& loose,
                                                  const FringeOptics& optics,
                                                  const AnchorByViewsOptions& options = {},
                                                  const Run& run = {});

}  // namespace frangia
