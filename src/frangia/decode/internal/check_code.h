#pragma once

#include "frangia/decode/internal/direction_maps.h"

namespace frangia {

/// Compares the Gray code of a direction with its coarsest map, unless the maps contradict each
/// other already: then their check stands. Of several declarations that fit, those stay with which
/// rig and code agree.
[[nodiscard]] SequenceCheck check_code(const DirectionInput& input,
                                       const FrameStack& gray,
                                       const DecodedDirection& wrapped);

}  // namespace frangia
