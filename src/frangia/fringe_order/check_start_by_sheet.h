#pragma once

#include <span>

#include "frangia/phase/temporal/check_sequence.h"
#include "frangia/phase/wrap/phase_map.h"
#include "frangia/range/laser_profile.h"
#include "frangia/rig/projector.h"

namespace frangia {

/// Compares the wrapped phase on the laser line with that of the points of the laser sheet. It
/// shows a wrong start or direction of the shifts of a single pattern.
///
/// @units    rad
/// @missing  not decided with fewer than 20 points of the line, or where their differences scatter
[[nodiscard]] SequenceCheck check_start_by_sheet(const WrappedPhase& phase,
                                                 std::span<const ProfilePoint> profile,
                                                 const Projector& projector);

}  // namespace frangia
