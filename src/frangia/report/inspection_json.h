#pragma once

#include <string>
#include <vector>

#include "frangia/inspection/inspect_part.h"

namespace frangia {

/// Returns an inspection as one JSON object: what `frangia inspect --json` prints of it, in
/// docs/json/inspect.schema.json. Members for what was not asked for are left out.
///
/// @units    mm and degrees, as the keys state
/// @missing  null
[[nodiscard]] std::string inspection_json(const Inspection& part);

/// Returns reasons as a JSON array: about what, the sentence in English, and its clauses with
/// their parameters, `reasons` of the same schema.
///
/// @missing  null
[[nodiscard]] std::string reasons_json(const std::vector<VerdictReason>& reasons);

}  // namespace frangia
