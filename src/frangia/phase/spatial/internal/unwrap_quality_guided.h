#pragma once

#include "frangia/phase/spatial/split_regions.h"
#include "frangia/phase/wrap/phase_map.h"

namespace frangia {

/// Unwraps each region by growth from its best pixel to the neighbour with the largest product of
/// modulations. The best pixel has fringe order 0. With `keep_growth_order` the order of growth is
/// recorded.
///
/// @source   the paper's reference [35], Takeda & Abe 1996
[[nodiscard]] RelativePhase unwrap_quality_guided(const WrappedPhase& phase,
                                                  const Regions& regions,
                                                  bool keep_growth_order = false);

}  // namespace frangia
