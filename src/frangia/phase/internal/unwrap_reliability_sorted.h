#pragma once

#include "frangia/phase/phase_map.h"
#include "frangia/phase/split_regions.h"

namespace frangia {

/// Unwraps each region by joining pixels along their edges, the most reliable first: those with the
/// smallest second differences. The best pixel of a region has fringe order 0.
///
/// @source   Herráez, Burton, Lalor and Gdeisat 2002
[[nodiscard]] RelativePhase unwrap_reliability_sorted(const WrappedPhase& phase,
                                                      const Regions& regions);

}  // namespace frangia
