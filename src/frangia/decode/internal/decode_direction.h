#pragma once

#include "frangia/decode/decode_view.h"
#include "frangia/decode/internal/direction_maps.h"

namespace frangia {

/// Decodes one direction of a view as its plan says. Each source of orders has its function.
///
/// @errors   as decode_view
[[nodiscard]] DecodedDirection decode_direction(const DirectionInput& input);

}  // namespace frangia
