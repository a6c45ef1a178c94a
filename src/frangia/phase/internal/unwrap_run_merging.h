#pragma once

#include <cstdint>
#include <vector>

#include "frangia/phase/phase_map.h"
#include "frangia/phase/split_regions.h"

namespace frangia {

/// Unwraps each region by linking the runs of its rows: first those whose shared pixels all ask for
/// the same whole number of fringes, then the others, those that share most first. Away from
/// residues every path gives the same phase, so that no pixel need be sorted. The fringe of the
/// best pixel of a region is called 0. Takes the maps out of `phase`.
///
/// source   after Herráez 2002, on runs in place of pixels
[[nodiscard]] RelativePhase unwrap_run_merging(WrappedPhase&& phase, Regions& regions);

/// The pixel of largest modulation in each region, as an index into the image.
[[nodiscard]] std::vector<std::uint32_t> best_pixels(const Image<float>& modulation,
                                                     const Image<std::int32_t>& label,
                                                     int count);

}  // namespace frangia
