#pragma once

#include <nlohmann/json.hpp>

#include "frangia/registration/refine_rig.h"

namespace frangia {

/// The findings of a refinement for `--json`.
[[nodiscard]] nlohmann::ordered_json json_of(const RigRefinement& refinement);

/// Prints a line for each parameter of a rig that changed.
void print_changes(const RigRefinement& refinement);

}  // namespace frangia
