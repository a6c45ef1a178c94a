#pragma once

#include <span>
#include <vector>

#include "frangia/pattern/pattern.h"
#include "frangia/pipeline/decode_view.h"
#include "frangia/rig/projector.h"

namespace frangia {

/// Whether the fringes and the Gray code of one direction determine its fringe orders.
[[nodiscard]] bool is_absolute_direction(std::span<const Pattern> patterns,
                                         FringeDirection direction,
                                         const Projector& projector);

/// Returns the directions of fringes to decode, the one that later stages refer to first: two only
/// if the patterns of both determine their fringe orders and `choice` uses both.
///
/// @errors   Error(Input) when there are no fringes, or none in the chosen direction
[[nodiscard]] std::vector<FringeDirection> directions_to_decode(std::span<const Pattern> patterns,
                                                                const Projector& projector,
                                                                DirectionChoice choice);

}  // namespace frangia
