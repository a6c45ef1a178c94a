#pragma once

#include <nlohmann/json.hpp>

#include "frangia/registration/refine_rig.h"

namespace frangia {

/// The findings of a refinement for `--json`.
[[nodiscard]] nlohmann::ordered_json json_of(const RigRefinement& refinement);

/// Prints the findings, and one line for each parameter that the part determines.
void print_refinement(const RigRefinement& refinement);

}  // namespace frangia
