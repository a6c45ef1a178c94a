#pragma once

#include "frangia/phase/spatial/split_regions.h"
#include "frangia/phase/wrap/phase_map.h"

namespace frangia {

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
