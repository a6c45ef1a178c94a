#pragma once

#include <span>
#include <vector>

#include "frangia/phase/phase_map.h"
#include "frangia/phase/unwrap_levels.h"
#include "frangia/phase/unwrap_temporally.h"
#include "frangia/rig/projector.h"

namespace frangia {

/// Absolute phase of the finest fringes from maps of any ratios: doubling, heterodyne, negative
/// exponential. All maps take part in the result, by the least-squares slope of phase over
/// frequency, each weighted by its own sigma.
///
/// shape    coarse to fine, all w x h
/// missing  a pixel missing in any map, or whose chance of a wrong order, summed over the steps, is
///          over the limit, is NaN and says why
/// errors   Error(Input) when empty, of different size, or when no map and no beat of two holds one
///          fringe or less over the field
/// source   Huntley and Saldner 1997 for the slope; Reich, Ritter and Thesing 1997 for beats
[[nodiscard]] AbsolutePhase unwrap_sequence(std::span<const WrappedPhase> coarse_to_fine,
                                            const Projector& projector,
                                            const TemporalUnwrapOptions& options = {});

}  // namespace frangia
