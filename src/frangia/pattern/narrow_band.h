#pragma once

#include "frangia/pattern/fringe_sequence.h"

namespace frangia {

/// Plans `maps` fringe counts of nearly the same high frequency whose combination determines the
/// order: the narrowest band below `fringes`, in steps of 2 % of it, that keeps the probability of
/// a wrong order.
///
/// Indirect light averages out over fine fringes. No map of such a sequence is coarse, so indirect
/// light reaches neither the phase nor its order, and it is nearly the same in all maps.
///
/// @units    rad
/// @errors   Error(Input) as `plan_beats`, or when no band above half of `fringes` suffices
/// @source   Gupta and Nayar 2012, Micro phase shifting
[[nodiscard]] SequencePlan plan_narrow_band(double fringes,
                                            int maps,
                                            double sigma_rad,
                                            double max_wrong_order = 1e-6);

}  // namespace frangia
