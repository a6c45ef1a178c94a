#pragma once

#include <string>

#include "frangia/inspection/inspect_part.h"

namespace frangia {

/// What an inspection found, in lines for people; `features`: with the table of all features.
[[nodiscard]] std::string inspection_text(const Inspection& part, bool features);

}  // namespace frangia
