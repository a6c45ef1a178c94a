#pragma once

#include <cstdint>
#include <vector>

#include "frangia/phase/spatial/split_regions.h"
#include "frangia/phase/wrap/phase_map.h"

namespace frangia {

/// Unwraps each region by joining the runs of its rows: first overlaps whose shared pixels all
/// imply the same whole number of fringes, then the others by descending number of votes. Away from
/// residues every path gives the same phase, so pixels need no sorting. The best pixel of a region
/// has fringe order 0. Moves the maps out of `phase` and the labels out of `regions`.
///
/// @source   after Herráez 2002, with runs in place of pixels
[[nodiscard]] RelativePhase unwrap_run_merging(WrappedPhase&& phase, Regions& regions);

/// The index of the pixel with the largest modulation in each region.
[[nodiscard]] std::vector<std::uint32_t> best_pixels(const Image<float>& modulation,
                                                     const Image<std::int32_t>& label,
                                                     int count);

}  // namespace frangia
