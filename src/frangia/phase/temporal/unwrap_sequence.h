#pragma once

#include <optional>
#include <span>

#include "frangia/phase/temporal/unwrap_temporally.h"
#include "frangia/phase/wrap/phase_map.h"
#include "frangia/rig/projector.h"

namespace frangia {

/// How the fringe orders of a sequence are found.
enum class SequenceMethod {
  Levels,  ///< each map or beat of two gives the orders of the next finer one
  Search   ///< of all orders of the finest map, the most likely one
};

/// Returns how maps of these patterns determine the orders of the finest one; none if they do not.
///
/// Where a map or a safe beat of two has at most one fringe over the field, each level is unwrapped
/// by the next coarser one. Otherwise all orders are searched for the most likely one, which needs
/// no map and no beat of one fringe: 64, 58 and 53 fringes suffice. Where the search would confuse
/// orders at 0.05 rad of noise, as with 16 and 15 fringes, the beats are used although they are not
/// safe: frames with less noise are unwrapped, and uncertain pixels are discarded.
///
/// @shape    coarse to fine; none when empty
/// @errors   Error(Input) for a period that is not above 0
[[nodiscard]] std::optional<SequenceMethod> find_sequence_method(
    std::span<const Pattern> coarse_to_fine, const Projector& projector);

/// Computes the absolute phase of the finest fringes from maps of arbitrary frequency ratios:
/// doubling, heterodyne, negative exponential, narrow bands. All maps contribute through the
/// weighted least-squares slope of phase over frequency; `find_sequence_method` has the method.
///
/// @shape    coarse to fine, all w x h
/// @missing  a pixel missing in any map, or whose probability of a wrong order, summed over the
///          levels, exceeds the limit, is NaN; its status states the reason
/// @errors   Error(Input) when empty, of different size, or when the method finds no combination of
///           the maps that is unique over the field
/// @source   Huntley and Saldner 1997 for the slope; Reich, Ritter and Thesing 1997 for beats
[[nodiscard]] AbsolutePhase unwrap_sequence(std::span<const WrappedPhase> coarse_to_fine,
                                            const Projector& projector,
                                            SequenceMethod method,
                                            const TemporalUnwrapOptions& options = {});

}  // namespace frangia
