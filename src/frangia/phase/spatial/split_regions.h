#pragma once

#include <cstdint>

#include "frangia/phase/wrap/phase_map.h"
#include "frangia/phase/wrap/smooth_jumps.h"

namespace frangia {

/// Where the phase is cut into regions.
struct SplitOptions {
  JumpOptions jumps;  ///< limits of smooth phase differences
};

/// Regions within which the phase is smooth and unwrapping is unambiguous.
struct Regions {
  Image<std::int32_t> label;         ///< 0, 1, ...; -1 where not measured
  int count = 0;                     ///< number of regions
  Image<std::uint8_t> smooth_right;  ///< as `smooth_right` of smooth_jumps.h
  Image<std::uint8_t> smooth_below;  ///< as `smooth_below` of smooth_jumps.h
};

/// Cuts the phase wherever it may hide a step of more than half a fringe, within the limits that
/// `SplitOptions` states. `join_regions` rejoins regions where that is safe.
///
/// @shape    w x h in and out
/// @missing  NaN pixels get the label -1
[[nodiscard]] Regions split_regions(const WrappedPhase& wrapped, const SplitOptions& options = {});

/// When two regions of the phase are joined.
struct JoinOptions {
  /// Two regions are joined when at least this fraction of their common border is smooth and
  /// implies the same whole number of fringes. 0.75 is a clear majority: a wrong join moves a
  /// region by whole fringes, a missed one leaves two regions.
  double min_agreement = 0.75;
};

/// Joins regions across borders that are safe, shifting one of them by whole fringes, and numbers
/// the regions from the largest. Regions whose border is partly a step stay separate.
///
/// @shape    `phase` and `regions` w x h
/// @units    rad
void join_regions(RelativePhase& phase, const Regions& regions, const JoinOptions& options = {});

}  // namespace frangia
