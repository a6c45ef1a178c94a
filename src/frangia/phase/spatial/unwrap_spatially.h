#pragma once

#include "frangia/core/enum_names.h"
#include "frangia/phase/spatial/split_regions.h"
#include "frangia/phase/wrap/phase_map.h"

namespace frangia {

/// The order in which the pixels of a region are unwrapped.
enum class SpatialMethod {
  RunMerging,        ///< runs of rows; the fastest, see `unwrap_run_merging`
  QualityGuided,     ///< growth along the largest product of modulations, as in the paper; see
                     ///< `unwrap_quality_guided`
  ReliabilitySorted  ///< edges sorted by reliability, see `unwrap_reliability_sorted`
};

/// What users call them.
[[nodiscard]] constexpr auto names_of(SpatialMethod /*any*/) {
  return EnumNames<SpatialMethod, 3>{{{SpatialMethod::RunMerging, "run-merging"},
                                      {SpatialMethod::QualityGuided, "quality-guided"},
                                      {SpatialMethod::ReliabilitySorted, "reliability-sorted"}}};
}

/// Method and limits of spatial unwrapping.
struct SpatialUnwrapOptions {
  SpatialMethod method = SpatialMethod::RunMerging;  ///< algorithm that unwraps within regions
  SplitOptions split;                                ///< where the phase is cut
  JoinOptions join;                                  ///< when regions are joined again
  /// Record the order in which quality-guided growth reaches the pixels, also when another method
  /// unwraps.
  bool keep_growth_order = false;
};

/// Computes a phase that is continuous within each region: discards residues, splits regions where
/// a step may hide, unwraps each region, and joins regions where that is safe.
///
/// @shape    w x h in and out
/// @units    rad
/// @missing  missing pixels and residues are NaN
[[nodiscard]] RelativePhase unwrap_spatially(WrappedPhase phase,
                                             const SpatialUnwrapOptions& options = {});

}  // namespace frangia
