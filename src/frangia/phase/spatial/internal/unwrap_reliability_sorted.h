#pragma once

#include "frangia/phase/spatial/split_regions.h"
#include "frangia/phase/wrap/phase_map.h"

namespace frangia {

/// Unwraps each region by joining pixels along their edges, the most reliable first: those with the
/// smallest second differences. The best pixel of a region has fringe order 0.
///
/// @source   Herráez, Burton, Lalor and Gdeisat 2002
[[nodiscard]] RelativePhase unwrap_reliability_sorted(const WrappedPhase& phase,
                                                      const Regions& regions);

}  // namespace frangia
