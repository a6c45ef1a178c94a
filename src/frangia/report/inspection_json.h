#pragma once

#include <string>

#include "frangia/inspection/inspect_part.h"

namespace frangia {

/// Returns an inspection as one JSON object: what `frangia inspect --json` prints of it, in
/// docs/json/inspect.schema.json. Members for what was not asked for are left out.
///
/// @units    mm and degrees, as the keys state
/// @missing  null
[[nodiscard]] std::string inspection_json(const Inspection& part);

}  // namespace frangia
