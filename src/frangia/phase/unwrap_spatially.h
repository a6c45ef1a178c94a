#pragma once

#include "frangia/phase/join_regions.h"
#include "frangia/phase/phase_map.h"
#include "frangia/phase/split_regions.h"

namespace frangia {

/// How the pixels of a region are put in order.
enum class SpatialMethod {
  RunMerging,        ///< runs of rows, see `unwrap_run_merging`: the fast one
  QualityGuided,     ///< growth along the largest product of modulations, the paper's, see
                     ///< `unwrap_quality_guided`
  ReliabilitySorted  ///< edges sorted by reliability, see `unwrap_reliability_sorted`
};

struct SpatialUnwrapOptions {
  SpatialMethod method = SpatialMethod::RunMerging;
  SplitOptions split;
  JoinOptions join;
  /// Keep the order in which the paper's growth reaches the pixels, to be looked at; where another
  /// method unwraps, it is that of the same regions by the growth.
  bool keep_growth_order = false;
};

/// Phase that is continuous within each region: residues discarded, regions split where a step may
/// hide, each unwrapped, and joined again where that is safe.
///
/// shape    w x h in and out
/// missing  pixels that were missing, and residues
[[nodiscard]] RelativePhase unwrap_spatially(WrappedPhase phase,
                                             const SpatialUnwrapOptions& options = {});

}  // namespace frangia
