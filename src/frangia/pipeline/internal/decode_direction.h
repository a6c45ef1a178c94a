#pragma once

#include "frangia/pipeline/decode_view.h"
#include "frangia/pipeline/internal/direction_maps.h"

namespace frangia {

/// Decodes one direction of a view as its plan says. Each source of orders has its function.
///
/// @errors   as decode_view
[[nodiscard]] DecodedView decode_direction(const DirectionInput& input);

}  // namespace frangia
