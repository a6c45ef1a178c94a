#pragma once

#include "frangia/phase/spatial/split_regions.h"
#include "frangia/phase/wrap/phase_map.h"

// The two ways of unwrapping that go from pixel to pixel.

namespace frangia {

/// Unwraps each region by growth from its best pixel to the neighbour with the largest product of
/// modulations. The best pixel has fringe order 0. With `keep_growth_order` the order of growth is
/// recorded.
///
/// @source   the paper's reference [35], Takeda & Abe 1996
[[nodiscard]] RelativePhase unwrap_quality_guided(const WrappedPhase& phase,
                                                  const Regions& regions,
                                                  bool keep_growth_order = false);

/// Unwraps each region by joining pixels along their edges, the most reliable first: those with the
/// smallest second differences. The best pixel of a region has fringe order 0.
///
/// @source   Herráez, Burton, Lalor and Gdeisat 2002
[[nodiscard]] RelativePhase unwrap_reliability_sorted(const WrappedPhase& phase,
                                                      const Regions& regions);

}  // namespace frangia
