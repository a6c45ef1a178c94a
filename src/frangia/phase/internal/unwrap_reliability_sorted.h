#pragma once

#include "frangia/phase/phase_map.h"
#include "frangia/phase/split_regions.h"

namespace frangia {

/// Unwraps each region by joining pixels along their edges, the most reliable first: those where
/// the phase bends least. The fringe of the best pixel of a region is called 0.
///
/// source   Herráez, Burton, Lalor and Gdeisat 2002
[[nodiscard]] RelativePhase unwrap_reliability_sorted(const WrappedPhase& phase,
                                                      const Regions& regions);

}  // namespace frangia
