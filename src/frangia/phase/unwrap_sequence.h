#pragma once

#include <span>
#include <vector>

#include "frangia/phase/phase_map.h"
#include "frangia/phase/unwrap_levels.h"
#include "frangia/phase/unwrap_temporally.h"
#include "frangia/rig/projector.h"

namespace frangia {

/// Computes the absolute phase of the finest fringes from maps of arbitrary frequency ratios:
/// doubling, heterodyne, negative exponential. All maps contribute through the weighted
/// least-squares slope of phase over frequency.
///
/// @shape    coarse to fine, all w x h
/// @missing  a pixel missing in any map, or whose probability of a wrong order, summed over the
///          levels, exceeds the limit, is NaN; its status states the reason
/// @errors   Error(Input) when empty, of different size, or when no map and no beat of two maps has
///          at most one fringe over the field
/// @source   Huntley and Saldner 1997 for the slope; Reich, Ritter and Thesing 1997 for beats
[[nodiscard]] AbsolutePhase unwrap_sequence(std::span<const WrappedPhase> coarse_to_fine,
                                            const Projector& projector,
                                            const TemporalUnwrapOptions& options = {});

}  // namespace frangia
